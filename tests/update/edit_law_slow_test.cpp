// The law (design, section 5): after any script of edits the cache converges to the same picture as
// a cache that was built from scratch on the edited scene, within noise.
#include "base/tone_map.h"
#include "sample_renderer/tiny_scenes.h"
#include "scene/built_in.h"
#include "scene/edit_history.h"
#include "update/session.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

namespace chiaro {
namespace {

constexpr int kWidth = 160, kHeight = 120;

SessionSettings settings_of(std::uint64_t seed) {
    SessionSettings s;
    s.update.threads = 2;
    s.update.seed = seed;
    s.update.fixed_size = true;
    s.width = kWidth;
    s.height = kHeight;
    return s;
}

// CHIARO_LAW_SEED: another one, to see how the ratios vary.
std::uint64_t seed_of_edited() {
    const char* seed = std::getenv("CHIARO_LAW_SEED");
    return seed ? std::strtoull(seed, nullptr, 10) : 7;
}

void run(Session& session, int cycles) {
    for (int i = 0; i < cycles; ++i) session.run();
}

template <typename Id, typename Things>
Id named(const Things& things, const std::string& name) {
    const auto found = std::ranges::find(things, name, [](const auto& t) { return t.name; });
    EXPECT_NE(found, things.end()) << name;
    return static_cast<Id>(found - things.begin());
}
ObjectId object(const Scene& scene, const std::string& name) {
    return named<ObjectId>(scene.objects, name);
}

Edit moved(const Scene& scene, const std::string& name, Vec3 by) {
    const ObjectId id = object(scene, name);
    const Mat4& place = scene.objects[index_of(id)].to_world;
    return SetTransform{id, glm::translate(Mat4(1), by) * place};
}
Edit removed(const Scene& scene, const std::string& name) {
    return SetShown{object(scene, name), false};
}
Edit painted(const Scene& scene, const std::string& name, Rgb color) {
    const auto id = named<MaterialId>(scene.materials, name);
    Material material = scene.material(id);
    material.base_color = color;
    return SetMaterial{id, material};
}
Edit lamp_moved(const Scene& scene, std::size_t lamp, Vec3 by, float dimmed) {
    SetLight edit = {static_cast<LightId>(lamp), scene.lights[lamp]};
    edit.value.position += by;
    edit.value.intensity *= dimmed;
    return edit;
}
Edit seen_from(Camera camera, Vec3 by) {
    camera.eye += by;
    return SetCamera{camera};
}

// On the scale on which pictures are compared, each at the exposure of `like`.
std::vector<float> tones(const Image& image, const Image& like) {
    const float exposure = comparison_exposure(like);
    std::vector<float> values;
    for (const Rgb& p : image.pixels) values.push_back(comparison_curve(exposure * luminance(p)));
    return values;
}

// Root mean square of the difference of two pictures, after means over squares of `side` pixels:
// what is left of noise that is independent from place to place shrinks, what has structure stays.
double difference(const Image& a, const Image& b, int side) {
    const std::vector<float> ta = tones(a, a), tb = tones(b, a);
    double sum = 0;
    int squares = 0;
    for (int y = 0; y + side <= kHeight; y += side)
        for (int x = 0; x + side <= kWidth; x += side) {
            double mean = 0;
            for (int j = 0; j < side; ++j)
                for (int i = 0; i < side; ++i) {
                    const auto at = static_cast<std::size_t>((y + j) * kWidth + x + i);
                    mean += double(ta[at] - tb[at]) / (side * side);
                }
            sum += mean * mean;
            ++squares;
        }
    return std::sqrt(sum / squares);
}

// Mean squared differences, by pixels and by squares.
struct Differences {
    double pixels = 0, squares = 0;
    void add(const Image& a, const Image& b, double part) {
        const double p = difference(a, b, 1), s = difference(a, b, 8);
        pixels += part * p * p;
        squares += part * s * s;
    }
};

// Compares `edited`, whose edits are behind it, with three fresh caches after as many cycles, which
// differ by their noise. That of the cells which end gathered rays is common to a whole picture, so
// that squares vary most: in 12 sessions of other seeds the ratios of the roots were 0.9 to 1.8.
void expect_law(Session& edited, int cycles, const std::string& what) {
    run(edited, cycles);
    const Image shown = edited.cycle().picture();
    std::vector<Image> fresh;
    for (std::uint64_t seed = 11; seed < 14; ++seed) {
        Session session(edited.scene(), edited.camera(), settings_of(seed));
        run(session, cycles);
        fresh.push_back(session.cycle().picture());
    }
    Differences differences, noise;
    for (std::size_t i = 0; i < 3; ++i) {
        differences.add(shown, fresh[i], 1.0 / 3);
        noise.add(fresh[i], fresh[(i + 1) % 3], 1.0 / 3);
    }
    EXPECT_LT(std::sqrt(differences.pixels / noise.pixels), 2.2) << what;
    EXPECT_LT(std::sqrt(differences.squares / noise.squares), 2.2) << what;
    EXPECT_LT(std::sqrt(noise.pixels), 0.05) << what << ": too noisy to tell";
    std::printf("%s: %.2f, %.2f of the noise\n", what.c_str(),
                std::sqrt(differences.pixels / noise.pixels),
                std::sqrt(differences.squares / noise.squares));
}

constexpr int kBefore = 30, kBetween = 4, kAfter = 60;

void test_script(const std::string& name, const std::function<std::vector<Edit>(const Scene&)>& f) {
    Scene scene = *built_in_scene(name);
    const Camera camera = scene.cameras.front();
    std::vector<Edit> edits = f(scene);
    edits.emplace_back(seen_from(camera, {0.2f, 0.1f, 0.1f}));
    Session session(std::move(scene), camera, settings_of(seed_of_edited()));
    run(session, kBefore);
    for (const Edit& edit : edits) {
        session.apply(edit);
        run(session, kBetween);
    }
    expect_law(session, kAfter, name);
}

TEST(EditLaw, Room) {
    test_script("room", [](const Scene& s) {
        return std::vector<Edit>{moved(s, "Ceiling lamp", {-0.9f, 0, 0.7f}),
                                 moved(s, "Coffee table", {0.3f, 0, 0.4f}),
                                 painted(s, "Sage paint", {0.6f, 0.2f, 0.15f}), removed(s, "Rug")};
    });
}

TEST(EditLaw, Indirect) {
    test_script("indirect", [](const Scene& s) {
        return std::vector<Edit>{
            moved(s, "Lamp", {0.2f, -0.3f, 0.2f}), moved(s, "Chair", {0.4f, 0, 0.3f}),
            painted(s, "Wall paint", {0.4f, 0.5f, 0.7f}), removed(s, "Sculpture")};
    });
}

TEST(EditLaw, PoolHall) {
    test_script("poolhall", [](const Scene& s) {
        return std::vector<Edit>{lamp_moved(s, 0, {0.4f, 0, 0}, 2),
                                 moved(s, "Ball 3", {0.3f, 0, 0.1f}),
                                 painted(s, "Wall paint", {0.6f, 0.3f, 0.2f}), removed(s, "Cue 1")};
    });
}

// A thousand edits at random, ten a cycle, under a pane of changing tint and a lamp that is off now
// and then; then all of them undone one by one, a few a cycle: nothing of any is left.
TEST(EditLaw, NothingIsLeftOfAThousandEditsThatAreUndone) {
    Scene scene = *built_in_scene("cornell");
    const Camera camera = scene.cameras.front();
    const MaterialId pane = tiny::add_glossy(scene, Rgb(0.9f), tiny::glass(0, true));
    tiny::add_quad(scene, {1.8f, 4.5f, 1.9f}, {0, 0, 1.8f}, {1, 0, 0}, pane);
    const Scene at_first = scene;
    Session session(std::move(scene), camera, settings_of(seed_of_edited()));
    EditHistory history;
    Rng rng(5);
    run(session, 10);
    const auto random = [&] { return 2 * rng.uniform() - 1; };
    for (int i = 0; i < 1000; ++i) {
        const Scene& now = session.scene();
        const auto o = static_cast<ObjectId>(3 + rng.below(2));  // the blocks
        const auto m = static_cast<MaterialId>(rng.below(3));
        const ObjectId lamp = object(now, "lamp");
        Material material = now.material(m);
        material.base_color = Rgb(rng.uniform(), rng.uniform(), rng.uniform());
        Material rough = now.material(m);
        rough.gloss = tiny::plastic(rng.uniform());
        Material tinted = now.material(pane);
        tinted.base_color = material.base_color;
        const bool on = rng.below(4) != 0;
        Camera look = camera;
        look.eye += 0.3f * Vec3(random(), random(), random());
        PunctualLight spot = {.name = "spot", .intensity = Rgb(rng.uniform())};
        spot.position = Vec3(2.78f + random(), 4, 2.78f + random());
        std::vector<Edit> one_of;
        one_of.emplace_back(
            SetTransform{o, glm::translate(Mat4(1), 0.5f * Vec3(random(), 0, random())) *
                                at_first.objects[index_of(o)].to_world});
        one_of.emplace_back(SetShown{o, rng.below(2) == 0});
        one_of.emplace_back(SetEmission{lamp, on ? Rgb(0.2f + rng.uniform()) : Rgb(0)});
        one_of.emplace_back(SetMaterial{m, material});
        one_of.emplace_back(SetMaterial{m, rough});
        one_of.emplace_back(SetMaterial{pane, tinted});
        one_of.emplace_back(SetCamera{look});
        if (now.lights.size() < 8) one_of.emplace_back(AddLight{spot});
        if (now.objects.size() < 12) one_of.emplace_back(AddObject{now.objects[index_of(o)]});
        const auto chosen = rng.below(static_cast<std::uint32_t>(one_of.size()));
        history.add(session.apply(one_of[chosen]));
        if (i % 10 == 9) session.run();
    }
    while (history.can_undo()) {
        history.undo([&](const Edit& edit) { return session.apply(edit); });
        if (rng.below(4) == 0) session.run();
    }
    for (std::size_t i = 0; i < at_first.objects.size(); ++i)
        EXPECT_EQ(session.scene().objects[i].to_world, at_first.objects[i].to_world);

    expect_law(session, kAfter, "a thousand edits");
}

}  // namespace
}  // namespace chiaro
