// A session that follows edits: what they cannot reach stays, what they reach is shaded again.
#include "update/session.h"

#include "base/tone_map.h"
#include "sample_renderer/tiny_scenes.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <optional>

namespace chiaro {
namespace {

// A hall of 10 x 3 x 10 m with a lamp of 10 cm in the middle of its ceiling and a box of 30 cm on
// the floor, 2 m from a corner; seen from above the lamp's height.
constexpr ObjectId kBox{2};
Scene hall() {
    Scene scene;
    tiny::add_room(scene, Vec3(0), Vec3(10, 3, 10), tiny::add_material(scene, Rgb(0.5f)));
    const MaterialId glow = tiny::add_material(scene, Rgb(0), Rgb(20'000));
    tiny::add_quad(scene, {4.95f, 2.9f, 4.95f}, {0.1f, 0, 0}, {0, 0, 0.1f}, glow);
    tiny::add_box(scene, {2, 0, 2}, {2.3f, 0.3f, 2.3f}, tiny::add_material(scene, Rgb(0.5f)));
    return scene;
}
const Camera kCamera = {.eye = {9.5f, 2.5f, 9.5f}, .target = {2, 0, 2}, .vertical_fov = 70};

SessionSettings settings() {
    SessionSettings s;
    s.update.threads = 2;
    s.update.fixed_size = true;
    s.width = 80;
    s.height = 60;
    return s;
}

void run(Session& session, int cycles) {
    for (int i = 0; i < cycles; ++i) session.run();
}

// "At least 80 % of the diffuse direct values that were valid and unaffected are kept": the box
// moves by 10 cm. Kept is what has the same samples and the same bits a cycle later, so that what
// was sampled further meanwhile counts as lost.
TEST(Session, WhatNoMovedShadowCanReachIsKept) {
    Session session(hall(), kCamera, settings());
    run(session, 20);
    const ShadingCache& cache = session.cycle().cache();
    std::vector<std::optional<Estimate>> before;
    for (std::size_t i = 0; i < cache.vertices().size(); ++i) {
        const Estimate* e = cache.estimate(static_cast<VertexId>(i), 0);
        before.push_back(e ? std::optional(*e) : std::nullopt);
    }
    session.apply(SetTransform{kBox, glm::translate(Mat4(1), Vec3(0.1f, 0, 0))});
    session.run();

    std::size_t valid = 0, kept = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (!before[i]) continue;
        ++valid;
        const Estimate* e = cache.estimate(static_cast<VertexId>(i), 0);
        kept += e && !e->stale && e->samples == before[i]->samples && e->mean == before[i]->mean;
    }
    EXPECT_GT(valid, 200u);
    EXPECT_GT(static_cast<double>(kept), 0.8 * static_cast<double>(valid));
}

// Light is linear: a lamp of a third of the power leaves a third of everything, at once within the
// noise of the first picture (5 %) and without a trace of what was three times as bright.
TEST(Session, ADimmedLampLeavesNothingOfWhatItWas) {
    Session session(hall(), kCamera, settings());
    run(session, 20);
    const Image before = session.cycle().picture();
    session.apply(SetEmission{ObjectId{1}, Rgb(1.0f / 3)});
    run(session, 20);
    const Image after = session.cycle().picture();
    double sum_before = 0, sum_after = 0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i) {
        sum_before += luminance(before.pixels[i]);
        sum_after += luminance(after.pixels[i]);
        EXPECT_LT(luminance(after.pixels[i]), 0.6f * luminance(before.pixels[i]) + 0.1f);
    }
    EXPECT_NEAR(sum_after / sum_before, 1.0 / 3, 0.05 / 3);
}

double mean_light(const Image& picture) {
    double sum = 0;
    for (const Rgb& p : picture.pixels) sum += luminance(p);
    return sum / static_cast<double>(picture.pixels.size());
}

// A pane under the lamp, clear and then smoky: what the black hall below gets straight from the
// lamp becomes what a fresh session finds, within the noise of few samples (3 %).
TEST(Session, ATintedPaneDimsWhatIsBehindIt) {
    Scene scene = hall();
    for (Material& material : scene.materials) material.base_color = Rgb(0);
    const MaterialId pane = tiny::add_glossy(scene, Rgb(1), tiny::glass(0, true));
    tiny::add_quad(scene, {4, 2.7f, 4}, {2, 0, 0}, {0, 0, 2}, pane);
    SessionSettings irradiance = settings();
    irradiance.update.aov = Aov::irradiance;
    Session session(std::move(scene), kCamera, irradiance);
    run(session, 10);
    const double clear = mean_light(session.cycle().picture());
    Material smoky = session.scene().material(pane);
    smoky.base_color = Rgb(0.25f);
    session.apply(SetMaterial{pane, smoky});
    run(session, 20);
    Session fresh(session.scene(), kCamera, irradiance);
    run(fresh, 20);
    const double truth = mean_light(fresh.cycle().picture());
    EXPECT_LT(truth, clear / 3);
    EXPECT_NEAR(mean_light(session.cycle().picture()), truth, 0.03 * truth);
}

// Every estimate in view that an edit has outdated is sampled again in the end, also one that an
// edit hardly changes: 400 cycles after a wall far behind the eye was painted, none is left.
TEST(Session, AllThatIsStaleInViewHasItsTurn) {
    Scene scene = hall();
    const MaterialId far = tiny::add_material(scene, Rgb(0.5f));
    tiny::add_quad(scene, {9.9f, 0, 9.9f}, {0, 0.2f, 0}, {-0.2f, 0, 0}, far);
    Camera elsewhere = kCamera;
    elsewhere.target = {9.5f, 1, 0};
    Session session(std::move(scene), elsewhere, settings());
    run(session, 10);
    session.apply(SetCamera{kCamera});
    run(session, 10);
    Material painted = session.scene().material(far);
    painted.base_color = Rgb(0.4f);
    session.apply(SetMaterial{far, painted});
    session.run();
    EXPECT_GT(session.cycle().stale(), 100u);
    run(session, 400);

    const ShadingCache& cache = session.cycle().cache();
    std::size_t stale = 0;
    for (const Patch& patch : cache.patches()) {
        if (!patch.is_leaf() || patch.fragment_count == 0) continue;
        for (int c = 0; c < patch.corner_count(); ++c)
            for (int channel = 0; channel < cache.channels(); ++channel)
                if (const Estimate* e = cache.estimate(patch.corners[c], channel))
                    stale += e->stale && !cache.vertex(patch.corners[c]).buried;
    }
    EXPECT_EQ(stale, 0u);
    // Nor is any counted, though some are stale out of view, as the eye finds when it looks there.
    EXPECT_EQ(session.cycle().stale(), 0u);
    session.apply(SetCamera{elsewhere});
    session.run();
    EXPECT_GT(session.cycle().stale(), 0u);
}

// The paper's scheme finds what changed by chance and by aging, and comes to the same: a dimmed
// lamp leaves a third of the light, within the noise of its 100 and 400 samples (3 %).
TEST(Session, ThePapersSchemeFollowsToo) {
    SessionSettings paper = settings();
    paper.update.scheme = Scheme::paper;
    paper.renderer = RendererName::path;
    Session session(hall(), kCamera, paper);
    run(session, 10);
    const Image before = session.cycle().picture();
    session.apply(SetEmission{ObjectId{1}, Rgb(1.0f / 3)});
    session.apply(SetTransform{kBox, glm::translate(Mat4(1), Vec3(0.1f, 0, 0))});
    run(session, 40);
    session.apply(SetTransform{kBox, Mat4(1)});
    run(session, 40);
    const Image after = session.cycle().picture();
    double sum_before = 0, sum_after = 0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i) {
        sum_before += luminance(before.pixels[i]);
        sum_after += luminance(after.pixels[i]);
    }
    EXPECT_NEAR(sum_after / sum_before, 1.0 / 3, 0.03 / 3);
}

// A polished ball that comes into a scene without gloss needs a channel that the cache does not
// have; the session makes another cache, and the ball shines.
TEST(Session, WhatNeedsAnotherChannelGetsIt) {
    Session session(hall(), kCamera, settings());
    run(session, 2);
    EXPECT_FALSE(session.cycle().cache().has_glossy());
    AddObject added;
    added.object.name = "glossy";
    added.mesh = session.scene().meshes[index_of(session.scene().objects[index_of(kBox)].mesh)];
    for (Primitive& p : added.mesh->primitives) p.material = MaterialId{0};
    added.materials.resize(1);
    added.materials[0].gloss = tiny::metal(0.4f);
    added.object.to_world = glm::translate(Mat4(1), Vec3(1, 0, 1));
    const Edit undo = session.apply(added);
    const std::size_t points = session.cycle().statistics().points_shaded;
    run(session, 2);
    EXPECT_TRUE(session.cycle().cache().has_glossy());
    EXPECT_EQ(session.scene().objects.size(), 4u);
    // What is counted goes on.
    EXPECT_EQ(session.cycle().statistics().cycles, 4u);
    EXPECT_GT(session.cycle().statistics().points_shaded, points);
    session.apply(undo);
    run(session, 2);
    EXPECT_FALSE(session.scene().objects[3].shown);
}

// A channel that nothing needs any more is kept, and with it all that is known: where nothing
// glossy is in view, a material that ceases to be glossy leaves no vertex to be evaluated anew.
TEST(Session, AChannelThatNothingNeedsIsKept) {
    Scene scene = hall();
    const MaterialId glossy = tiny::add_glossy(scene, Rgb(0.5f), tiny::metal(0.4f));
    Session session(std::move(scene), kCamera, settings());
    run(session, 10);
    const std::size_t known = session.cycle().cache().vertices().size();
    session.apply(SetMaterial{glossy, Material()});
    session.run();
    EXPECT_TRUE(session.cycle().cache().has_glossy());
    EXPECT_GE(session.cycle().cache().vertices().size(), known);
}

// Without light all is black, which is no sign of burial: nothing is divided in search of light at
// once, and where all is known to be black, hardly anything later (2 %, by chance). When the lamp
// is on again the light is that of a fresh session, within the noise (3 %).
TEST(Session, DarknessIsNotTakenForBurial) {
    Session session(hall(), kCamera, settings());
    const auto patches = [&] {
        return static_cast<double>(session.cycle().cache().patches().size());
    };
    run(session, 10);
    const double lit = patches();
    session.apply(SetEmission{ObjectId{1}, Rgb(0)});
    session.run();
    EXPECT_LT(patches(), 1.05 * lit);
    run(session, 20);
    const double known = patches();
    run(session, 20);
    EXPECT_LT(patches(), 1.02 * known);
    EXPECT_EQ(mean_light(session.cycle().picture()), 0);

    session.apply(SetEmission{ObjectId{1}, Rgb(1)});
    run(session, 20);
    Session fresh(hall(), kCamera, settings());
    run(fresh, 20);
    const double truth = mean_light(fresh.cycle().picture());
    EXPECT_NEAR(mean_light(session.cycle().picture()), truth, 0.03 * truth);
}

// What is set to what it is, and set back, is no edit: the picture has the same bits as if nobody
// had touched anything, and nothing is stale.
TEST(Session, WhatRestsIsNoEdit) {
    Session touched(hall(), kCamera, settings());
    Session left_alone(hall(), kCamera, settings());
    for (int i = 0; i < 10; ++i) {
        const Edit undo = touched.apply(SetTransform{kBox, Mat4(1)});
        touched.apply(SetCamera{kCamera});
        touched.apply(SetMaterial{MaterialId{0}, touched.scene().material(MaterialId{0})});
        touched.apply(undo);
        touched.run();
        left_alone.run();
        EXPECT_EQ(touched.cycle().stale(), 0u);
    }
    EXPECT_EQ(touched.scene().objects[index_of(kBox)].to_world, Mat4(1));
    EXPECT_EQ(touched.cycle().picture().pixels, left_alone.cycle().picture().pixels);
}

// The same edits between the same cycles give the same bits on any number of threads.
TEST(Session, EditsGiveTheSameBitsOnAnyNumberOfThreads) {
    std::vector<Image> pictures;
    for (const int threads : {1, 3}) {
        SessionSettings s = settings();
        s.update.threads = threads;
        Session session(hall(), kCamera, s);
        run(session, 6);
        session.apply(SetTransform{kBox, glm::translate(Mat4(1), Vec3(1, 0, 0))});
        run(session, 4);
        session.apply(SetEmission{ObjectId{1}, Rgb(2)});
        Camera nearer = kCamera;
        nearer.eye -= Vec3(1, 0, 1);
        session.apply(SetCamera{nearer});
        run(session, 6);
        pictures.push_back(session.cycle().picture());
    }
    for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i)
        ASSERT_EQ(pictures[0].pixels[i], pictures[1].pixels[i]) << "pixel " << i;
}

// A box that is dragged on and on shades again what it reaches meanwhile, not only once it rests,
// and in each of 30 steps; also indirect light, of which each step changes little.
TEST(Session, WhatIsDraggedIsShadedMeanwhile) {
    Session session(hall(), kCamera, settings());
    run(session, 20);
    const Statistics before = session.cycle().statistics();
    for (int i = 0; i < 30; ++i) {
        const float x = 0.02f * static_cast<float>(i);
        session.apply(SetTransform{kBox, glm::translate(Mat4(1), Vec3(x, 0, 0))});
        session.run();
    }
    const Statistics& after = session.cycle().statistics();
    EXPECT_GT(after.points_shaded, before.points_shaded + 30 * 20);
    constexpr int kIndirect = 1, kFirstSamples = 64;
    EXPECT_GT(after.samples[kIndirect], before.samples[kIndirect] + 30 * 20 * kFirstSamples);
}

// A lamp that swings, moved before each of 80 cycles: memory is what one place of it needs, within
// a half.
TEST(Session, ALampThatSwingsLeavesNoMemory) {
    Session swung(hall(), kCamera, settings());
    run(swung, 20);
    const std::size_t at_rest = swung.cycle().bytes();
    for (int i = 0; i < 80; ++i) {
        const float x = std::sin(0.1f * static_cast<float>(i));
        swung.apply(SetTransform{ObjectId{1}, glm::translate(Mat4(1), Vec3(x, 0, 0))});
        swung.run();
    }
    EXPECT_LT(static_cast<double>(swung.cycle().bytes()), 1.5 * static_cast<double>(at_rest));
}

// The hall with a lamp that has no surface, 1 m below the ceiling.
Scene hall_with_bulb() {
    Scene scene = hall();
    PunctualLight bulb = {.name = "bulb", .intensity = Rgb(800)};
    bulb.position = Vec3(5, 2, 5);
    scene.lights.push_back(bulb);
    return scene;
}
Edit bulb_at(const Session& session, Vec3 place, float part) {
    SetLight edit = {LightId{0}, session.scene().lights[0]};
    edit.value.position = place;
    edit.value.intensity = Rgb(800 * part);
    return edit;
}

double mean_luminance(const Image& picture) {
    double sum = 0;
    for (const Rgb& p : picture.pixels) sum += luminance(p);
    return sum / static_cast<double>(picture.pixels.size());
}

// Where a light without a surface moves, no ray is sent to see anything again, and fragments stay
// as fine as they are; where the box moves, rays through fewer than half of the pixels are.
TEST(Session, OnlyWhatIsSeenOtherwiseIsSeenAgain) {
    Session session(hall_with_bulb(), kCamera, settings());
    run(session, 10);
    const std::size_t pixels = 80 * 60;
    const auto seen = [&] { return session.cycle().statistics().pixels_seen; };
    const std::size_t fragments = session.cycle().id_map().fragments.size();
    const std::size_t at_first = seen();
    for (int i = 0; i < 5; ++i) {
        const float x = 4 + 0.5f * static_cast<float>(i);
        session.apply(bulb_at(session, Vec3(x, 2, 5), 1));
        session.run();
    }
    run(session, 5);
    EXPECT_EQ(seen(), at_first);
    EXPECT_EQ(session.cycle().id_map().fragments.size(), fragments);

    // The first time all is seen, to know where rays go.
    const auto move_box = [&](float x) {
        session.apply(SetTransform{kBox, glm::translate(Mat4(1), Vec3(x, 0, 0))});
        session.run();
    };
    move_box(0.1f);
    EXPECT_EQ(seen(), at_first + pixels);
    move_box(0.2f);
    EXPECT_GT(seen(), at_first + pixels);
    EXPECT_LT(seen(), at_first + pixels + pixels / 2);
}

// Lamp and bulb swing for 240 edits, and rest: the last picture is that of a fresh session, within
// the noise that two of these have between them, and memory is what one place of them needs,
// within a half.
TEST(Session, AfterLongSwingsNothingIsLeftOfThem) {
    Session swung(hall_with_bulb(), kCamera, settings());
    run(swung, 20);
    const std::size_t at_rest = swung.cycle().bytes();
    for (int i = 0; i < 120; ++i) {
        const float x = std::sin(0.1f * static_cast<float>(i));
        swung.apply(bulb_at(swung, Vec3(5 + x, 2, 5), 1.5f + x));
        swung.apply(SetTransform{ObjectId{1}, glm::translate(Mat4(1), Vec3(x, 0, 0))});
        swung.run();
    }
    EXPECT_LT(static_cast<double>(swung.cycle().bytes()), 1.5 * static_cast<double>(at_rest));
    swung.apply(bulb_at(swung, Vec3(4, 2, 5), 1));
    swung.apply(SetTransform{ObjectId{1}, Mat4(1)});
    run(swung, 40);

    std::vector<Image> fresh;
    for (const std::uint64_t seed : {11, 12}) {
        SessionSettings s = settings();
        s.update.seed = seed;
        Session session(swung.scene(), kCamera, s);
        run(session, 40);
        fresh.push_back(session.cycle().picture());
    }
    const Image shown = swung.cycle().picture();
    double apart = 0, noise = 0;
    for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
        const double a = luminance(shown.pixels[i]);
        const double b = luminance(fresh[0].pixels[i]), c = luminance(fresh[1].pixels[i]);
        apart += (a - b) * (a - b);
        noise += (b - c) * (b - c);
    }
    EXPECT_LT(std::sqrt(apart / noise), 2.2);
    EXPECT_NEAR(mean_luminance(shown) / mean_luminance(fresh[0]), 1, 0.01);
}

}  // namespace
}  // namespace chiaro
