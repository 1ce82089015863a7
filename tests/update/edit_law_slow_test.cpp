// The law (design, section 5): after any script of edits the cache converges to the same picture as
// a cache that was built from scratch on the edited scene, within noise.
#include "base/tone_map.h"
#include "scene/built_in.h"
#include "scene/edit_history.h"
#include "update/session.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
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

struct Law {
    double pixels = 0, squares = 0;                    // difference of the edited and a fresh cache
    double noise_of_pixels = 0, noise_of_squares = 0;  // of two fresh ones
};

// `edited`, that had its edits a while ago, beside caches that know nothing else.
Law law_of(Session& edited, int cycles) {
    run(edited, cycles);
    Session one(edited.scene(), edited.camera(), settings_of(11));
    Session other(edited.scene(), edited.camera(), settings_of(12));
    run(one, cycles);
    run(other, cycles);
    const Image a = edited.cycle().picture(), b = one.cycle().picture(),
                c = other.cycle().picture();
    constexpr int kSide = 8;
    return {difference(a, b, 1), difference(a, b, kSide), difference(b, c, 1),
            difference(b, c, kSide)};
}

// Fresh caches of two seeds differ by their noise. In 40 comparisons of further seeds their
// differences varied by less than a fifth, so that a factor of 1.5 is not left by chance.
void expect_law(const Law& law, const std::string& what) {
    EXPECT_LT(law.pixels, 1.5 * law.noise_of_pixels) << what;
    EXPECT_LT(law.squares, 1.5 * law.noise_of_squares) << what;
    EXPECT_LT(law.noise_of_pixels, 0.05) << what << ": too noisy to tell";
}

constexpr int kBefore = 30, kBetween = 4, kAfter = 80;

void test_script(const std::string& name, const std::function<std::vector<Edit>(const Scene&)>& f) {
    Scene scene = *built_in_scene(name);
    const Camera camera = scene.cameras.front();
    std::vector<Edit> edits = f(scene);
    edits.emplace_back(seen_from(camera, {0.2f, 0.1f, 0.1f}));
    Session session(std::move(scene), camera, settings_of(7));
    run(session, kBefore);
    for (const Edit& edit : edits) {
        session.apply(edit);
        run(session, kBetween);
    }
    expect_law(law_of(session, kAfter), name);
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

// A thousand edits at random, four a cycle, then all of them undone: nothing of any is left.
TEST(EditLaw, NothingIsLeftOfAThousandEditsThatAreUndone) {
    Scene scene = *built_in_scene("cornell");
    const Camera camera = scene.cameras.front();
    const Scene at_first = scene;
    Session session(std::move(scene), camera, settings_of(7));
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
        Camera look = camera;
        look.eye += 0.3f * Vec3(random(), random(), random());
        PunctualLight spot = {.name = "spot", .intensity = Rgb(rng.uniform())};
        spot.position = Vec3(2.78f + random(), 4, 2.78f + random());
        std::vector<Edit> one_of;
        one_of.emplace_back(
            SetTransform{o, glm::translate(Mat4(1), 0.5f * Vec3(random(), 0, random())) *
                                at_first.objects[index_of(o)].to_world});
        one_of.emplace_back(SetShown{o, rng.below(2) == 0});
        one_of.emplace_back(SetEmission{lamp, Rgb(0.2f + rng.uniform())});
        one_of.emplace_back(SetMaterial{m, material});
        one_of.emplace_back(SetCamera{look});
        if (now.lights.size() < 8) one_of.emplace_back(AddLight{spot});
        if (now.objects.size() < 12) one_of.emplace_back(AddObject{now.objects[index_of(o)]});
        const auto chosen = rng.below(static_cast<std::uint32_t>(one_of.size()));
        history.add(session.apply(one_of[chosen]));
        if (i % 4 == 3) session.run();
    }
    while (history.can_undo()) history.undo([&](const Edit& edit) { return session.apply(edit); });
    for (std::size_t i = 0; i < at_first.objects.size(); ++i)
        EXPECT_EQ(session.scene().objects[i].to_world, at_first.objects[i].to_world);

    run(session, kAfter);
    Session one(at_first, camera, settings_of(11)), other(at_first, camera, settings_of(12));
    run(one, kAfter);
    run(other, kAfter);
    const Image a = session.cycle().picture(), b = one.cycle().picture(),
                c = other.cycle().picture();
    expect_law({difference(a, b, 1), difference(a, b, 8), difference(b, c, 1), difference(b, c, 8)},
               "a thousand edits");
}

}  // namespace
}  // namespace chiaro
