// Surfaces that are not diffuse, through the cache.
#include "sample_renderer/whites.h"
#include "update/studio.h"

namespace chiaro {
namespace {

using namespace tiny;

// What absorbs nothing cannot be seen in an even sky, whichever way it is shaded. Chains of
// reflections within glass are cut after all but 1 %, noise leaves no pixel more than 0.15 and the
// mean 0.01 off.
TEST(Glossy, WhateverAbsorbsNothingVanishesInAnEvenSky) {
    for (const White& white : kWhites)
        for (const Truth by : kTruths) {
            Scene scene;
            scene.environment.sky = {1, 2, 0};
            add_white_box(scene, white);
            Studio studio(std::move(scene), fixed_size(Scheme::best, Aov::radiance), by);
            studio.cycle.look_from(View({.eye = {3, 4, 5}, .target = {0, 0, 0}}, 32, 24));
            studio.run(6);
            const Image picture = studio.cycle.picture();
            float worst = 0;
            for (const Rgb& p : picture.pixels) {
                worst = std::max({worst, std::abs(p.r - 1), std::abs(p.g / 2 - 1)});
                EXPECT_EQ(p.b, 0);
            }
            EXPECT_LT(worst, 0.15f) << white.name << " " << int(by);
            EXPECT_NEAR(mean_of(picture).r, 1, 0.01) << white.name << " " << int(by);
        }
}

// A coloured box, which sees nothing of itself, shows its albedo at the angle of each pixel times
// the sky. Of the pixels whose neighbours show the same face; tables are exact to 0.006, and noise
// leaves the mean 0.01 off.
TEST(Glossy, ColouredThingsShowTheirAlbedoTimesTheSky) {
    const Rgb sky(1, 2, 5);
    for (const Gloss& gloss : {Gloss(), metal(0), metal(0.15f), metal(0.5f), plastic(0),
                               plastic(0.15f), plastic(0.5f), varnish(), mirror({0.9f, 0.5f, 0})}) {
        Scene scene;
        scene.environment.sky = sky;
        add_box(scene, Vec3(-1), Vec3(1), add_glossy(scene, {0.8f, 0.5f, 0.2f}, gloss));
        Studio studio(std::move(scene), fixed_size(Scheme::best, Aov::radiance), Truth::path);
        const View view({.eye = {3, 4, 5}, .target = {0, 0, 0}, .vertical_fov = 30}, 32, 24);
        studio.cycle.look_from(view);
        studio.run(6);
        const Image picture = studio.cycle.picture();
        const auto face = [&](float x, float y) {
            const Ray ray = view.ray(x, y);
            Hit hit;
            studio.rays.intersect({&ray, 1}, {&hit, 1});
            return hit;
        };
        Rgb shown(0), expected(0);
        int compared = 0;
        for (int x = 0; x < 32; ++x)
            for (int y = 0; y < 24; ++y) {
                const float left = float(x) - 0.5f, top = float(y) - 0.5f;
                const Hit hit = face(left + 1, top + 1);
                const auto same = [&](float dx, float dy) {
                    const Hit other = face(left + dx, top + dy);
                    return other && other.point.primitive == hit.point.primitive;
                };
                if (!hit || !same(0, 0) || !same(2, 0) || !same(0, 2) || !same(2, 2)) continue;
                const Vec3 to_eye = -glm::normalize(view.ray(left + 1, top + 1).direction);
                shown += picture.at(x, y);
                ++compared;
                expected += sky * total_albedo(bsdf_at(studio.scene, hit.point, true),
                                               glm::dot(to_eye, hit.normal));
            }
        EXPECT_GT(compared, 100);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(shown[c], expected[c], 0.015f * expected[c]) << gloss.roughness;
    }
}

// A room with a lamp and a floor of that gloss.
Scene room(const Gloss& gloss) {
    Scene scene;
    const MaterialId white = add_material(scene, Rgb(0.7f));
    const MaterialId red = add_material(scene, {0.7f, 0.1f, 0.05f});
    const MaterialId floor = add_glossy(scene, Rgb(0.8f), gloss);
    add_quad(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, floor);
    add_quad(scene, {-2, 3, -2}, {4, 0, 0}, {0, 0, 4}, white);
    add_quad(scene, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, white);
    add_quad(scene, {2, 0, 2}, {-4, 0, 0}, {0, 3, 0}, white);
    add_quad(scene, {-2, 0, 2}, {0, 0, -4}, {0, 3, 0}, red);
    add_quad(scene, {2, 0, -2}, {0, 0, 4}, {0, 3, 0}, white);
    add_quad(scene, {-0.5f, 2.9f, -0.5f}, {1, 0, 0}, {0, 0, 1},
             add_material(scene, Rgb(0), Rgb(50)));
    return scene;
}
View view_of_floor(Vec3 eye) {
    return {{.eye = eye, .target = {0, 0, 0}, .vertical_fov = 60}, 48, 36};
}

double rms_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = luminance(a.pixels[i]) - luminance(b.pixels[i]);
        sum += d * d;
    }
    return std::sqrt(sum / double(a.pixels.size())) / luminance(mean_of(b));
}

// Vertices that have nothing glossy are never asked for it, and a session whose scene has no rough
// gloss, or whose picture is of irradiance, has no channel for it.
TEST(Glossy, OnlyRoughGlossIsCached) {
    const auto channels = [](const Gloss& gloss, Aov aov) {
        Studio studio(room(gloss), fixed_size(Scheme::best, aov));
        return studio.cycle.cache().channels();
    };
    EXPECT_EQ(channels({}, Aov::radiance), 2);
    EXPECT_EQ(channels(metal(0), Aov::radiance), 2);
    EXPECT_EQ(channels(metal(0.5f), Aov::radiance), 3);
    EXPECT_EQ(channels(metal(0.5f), Aov::irradiance), 2);

    for (const Scheme scheme : {Scheme::best, Scheme::paper}) {
        Studio studio(room(metal(0.5f)), fixed_size(scheme, Aov::radiance));
        studio.cycle.look_from(view_of_floor({0, 1.5f, 1.9f}));
        studio.run(8);
        const ShadingCache& cache = studio.cycle.cache();
        const int glossy = cache.channels() - 1;
        std::size_t asked = 0;
        for (std::uint32_t v = 0; v < cache.vertices().size(); ++v) {
            const auto vertex = static_cast<VertexId>(v);
            const bool on_floor = index_of(cache.surface_point(vertex).object) == 0;
            if (cache.evaluated(vertex, glossy)) {
                EXPECT_TRUE(on_floor);
                ++asked;
            }
            // And a metal floor has no use for irradiance.
            if (cache.evaluated(vertex, 0)) {
                EXPECT_FALSE(on_floor);
            }
        }
        EXPECT_GT(asked, 20u);
    }
}

// Gloss is evaluated by 128 samples at least, from the first cycle on: by 32, most vertices of a
// varnished rail found no lamp, and their noise was taken for detail.
TEST(Glossy, StartsWithEnoughSamplesToFindLamps) {
    Studio studio(room(plastic(0.45f)), fixed_size(Scheme::best, Aov::radiance));
    studio.cycle.look_from(view_of_floor({0, 1.5f, 1.9f}));
    studio.run(6);
    const ShadingCache& cache = studio.cycle.cache();
    std::size_t evaluated = 0;
    for (std::uint32_t v = 0; v < cache.vertices().size(); ++v)
        if (const Estimate* e = cache.estimate(VertexId{v}, 2)) {
            EXPECT_GE(e->samples, 128u);
            ++evaluated;
        }
    EXPECT_GT(evaluated, 10u);
}

// Glossy light is its eye's: after a move the picture comes to what a fresh cache shows from there,
// and one that kept what the first eye saw would be 30 % off. Noise is below 2 % in either.
TEST(Glossy, ACameraMoveLeadsToThePictureOfAFreshCache) {
    Studio moved(room(metal(0.35f)), fixed_size(Scheme::best, Aov::radiance));
    Studio fresh(room(metal(0.35f)), fixed_size(Scheme::best, Aov::radiance));
    const View first = view_of_floor({0, 1.5f, 1.9f}), second = view_of_floor({-1.9f, 0.8f, 0});
    moved.cycle.look_from(first);
    moved.run(8);
    moved.cycle.look_from(second);
    moved.run(12);
    fresh.cycle.look_from(second);
    fresh.run(12);
    EXPECT_LT(rms_difference(moved.cycle.picture(), fresh.cycle.picture()), 0.03);

    // The same eye that turns keeps what it knows.
    fresh.cycle.look_from(first);
    fresh.run(3);
    const auto glossy_samples = [&] { return fresh.cycle.statistics().samples[2]; };
    fresh.cycle.look_from(first);
    const std::size_t samples = glossy_samples();
    fresh.run(2);
    EXPECT_EQ(glossy_samples(), samples);
}

// A lamp that is a point shows in polish, found by light samples: of 1 cd at 1 m on either side of
// the normal, at 45 degrees, facets of width a that reflect all send 1 / (4 pi a^2 cos^2) x cos,
// the density of even facets times visibility (about 1 / (4 cos^2)) times the irradiance.
TEST(Glossy, PolishShowsPointLights) {
    Scene scene;
    const MaterialId polish = add_glossy(scene, Rgb(1), metal(0.2f));
    add_quad(scene, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, polish);
    const float s = std::sqrt(0.5f);
    scene.lights.push_back(point_light({-s, s, 0}, Rgb(1)));
    Studio studio(std::move(scene), fixed_size(Scheme::best, Aov::radiance));
    studio.cycle.look_from(
        View({.eye = {s, s, 0}, .target = {0, 0, 0}, .vertical_fov = 0.2f}, 5, 5));
    studio.run(3);
    const float alpha = 0.04f;
    EXPECT_NEAR(studio.cycle.picture().at(2, 2).g / (1 / (4 * kPi * alpha * alpha * s)), 1, 0.02);
}

}  // namespace
}  // namespace chiaro
