// Surfaces that are not diffuse, in light transport.
#include "sample_renderer/meter.h"
#include "sample_renderer/whites.h"
#include "scene/bsdf.h"
#include "scene/fresnel.h"

#include <gtest/gtest.h>

namespace chiaro::tiny {
namespace {

Rgb seen(const Meter& meter, Vec3 from, Vec3 toward, std::uint32_t samples) {
    const Ray ray = {from, glm::normalize(toward - from)};
    Rgb result;
    radiance(meter.lit, {&ray, 1}, {.seed = 3, .samples = samples}, {&result, 1});
    return result;
}

// That box in a closed room of one radiance, 1 cd/m2: half of it the walls' own, half reflected.
Scene furnace(const White& white) {
    Scene scene;
    add_room(scene, Vec3(-3), Vec3(3), add_material(scene, Rgb(0.5f), Rgb(0.5f)));
    add_white_box(scene, white);
    return scene;
}

// The tables that keep the energy are exact to 0.005, and weights of single paths lie below 3:
// an error of 0.02 at 20000 paths is more than 6 deviations.
TEST(Materials, WhatAbsorbsNothingIsWhiteInWhiteSurroundings) {
    for (const White& white : kWhites) {
        const Meter meter(furnace(white));
        for (const Vec3 from : {Vec3(0.2f, 0.3f, 2.5f), Vec3(2.5f, 0.4f, 1.2f)})
            EXPECT_NEAR(seen(meter, from, {0.1f, 0.2f, 0.9f}, 20'000).g, 1, 0.02) << white.name;
    }
}

// Irradiance close to it is pi by every renderer, in a closed room and under an even sky. Standard
// errors of `path` up to 0.8 % a surface, 0.2 % in the mean of all.
TEST(Materials, WhatAbsorbsNothingLightsItsNeighboursAsWhiteSurroundingsDo) {
    const Vec3 place(1.3f, 0.3f, 0.2f), normal = glm::normalize(Vec3(-1, 0.2f, 0.3f));
    for (const Truth by : kTruths)
        for (const bool closed : {true, false}) {
            double mean = 0;
            std::uint32_t seed = 0;
            for (const White& white : kWhites) {
                Scene open;
                open.environment.sky = Rgb(1);
                add_white_box(open, white);
                const Meter meter(closed ? furnace(white) : std::move(open), by);
                const std::uint32_t samples = meter.worth(1 << 13);
                const double e = meter.at(place, normal, Light::total, samples, ++seed).mean.g;
                EXPECT_NEAR(e / kPi, 1, within(by, 0.06)) << white.name << " " << int(by);
                mean += e / kPi / std::size(kWhites);
            }
            EXPECT_NEAR(mean, 1, within(by, 0.016)) << closed << " " << int(by);
        }
}

TEST(Materials, AMirrorShowsTheLampTimesItsReflectance) {
    Scene scene;
    add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0},
             add_glossy(scene, {0.9f, 0.5f, 0.1f}, metal(0)));
    add_quad(scene, {1, -1, 2}, {0, 2, 0}, {2, 0, 0}, add_material(scene, Rgb(0), Rgb(10)));
    const Meter meter(std::move(scene));
    // At cos 45 degrees Schlick adds (1 - cos)^5 of what is left.
    const float grazing = std::pow(1 - std::sqrt(0.5f), 5.0f);
    const Rgb lamp = seen(meter, {-2, 0, 2}, {0, 0, 0}, 16);
    EXPECT_NEAR(lamp.r, 10 * (0.9f + 0.1f * grazing), 1e-3);
    EXPECT_NEAR(lamp.b, 10 * (0.1f + 0.9f * grazing), 1e-3);
}

// No chance in it: a sun is asked once, and roulette comes after.
TEST(Materials, AHighlightOfTheSunIsTheValueTimesItsLight) {
    Scene scene;
    const MaterialId id = add_glossy(scene, Rgb(0.6f), metal(0.5f));
    add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, id);
    scene.lights = {sun({-1, 0, -1}, Rgb(1000))};
    const Meter meter(std::move(scene));
    const Vec3 eye(-2, 0, 3);
    const Bsdf b = bsdf_at(meter.scene, meter.look(eye, -eye).point, true);
    const Vec3 to_sun = glm::normalize(Vec3(1, 0, 1));
    const Rgb value = eval_bsdf(b, glm::normalize(eye), to_sun) * to_sun.z * 1000.0f;
    EXPECT_NEAR(seen(meter, eye, {0, 0, 0}, 4).g / value.g, 1, 1e-4);
}

// 100 cd at 2 m height, a pane of index 1.5 halfway: what passes at the angle of each point.
TEST(Materials, APaneLetsShadowRaysThroughAndTintsThem) {
    const Rgb tint(0.8f, 0.5f, 0.2f);
    const auto room = [&](bool lamp_is_point) {
        Scene scene;
        add_quad(scene, {-5, -5, 1}, {10, 0, 0}, {0, 10, 0},
                 add_glossy(scene, tint, glass(0, true)));
        if (lamp_is_point)
            scene.lights = {point_light({0, 0, 2}, Rgb(100))};
        else
            add_quad(scene, {-0.05f, -0.05f, 2}, {0, 0.1f, 0}, {0.1f, 0, 0},
                     add_material(scene, Rgb(0), Rgb(10'000)));
        return scene;
    };
    for (const bool point : {true, false}) {
        const Meter meter(room(point));
        for (const float x : {0.0f, 1.0f, 2.5f}) {
            const float squared = x * x + 4, cosine = 2 / std::sqrt(squared);
            const float lux = 100 * cosine / squared * (point ? 1 : cosine);
            const Rgb through = split_at_pane(fresnel_dielectric(cosine, 1.5f), tint).transmitted;
            const Rgb e = meter.at({x, 0, 0}, {0, 0, 1}, Light::direct, 4096).mean;
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e[c] / (lux * through[c]), 1, point ? 1e-4 : 0.01) << x << " " << c;
            // What passes straight is no indirect light.
            const Rgb more = meter.at({x, 0, 0}, {0, 0, 1}, Light::indirect, 4096).mean;
            EXPECT_EQ(max_component(more), 0) << x;
        }
    }
}

// All that comes from a large lamp close to a point goes through the pane, whoever finds it: next
// event estimation and chance share the light without counting any of it twice.
TEST(Materials, BehindAPaneALargeLampIsAsBrightAsThePaneLets) {
    Scene scene;
    add_room(scene, Vec3(-3), Vec3(3), add_material(scene, Rgb(0), Rgb(1)));
    add_quad(scene, {-3, -3, 0.5f}, {6, 0, 0}, {0, 6, 0},
             add_glossy(scene, Rgb(1), glass(0, true)));
    const Meter meter(std::move(scene));
    // Clear, so what the pane does not let through of the light above, it reflects of that below.
    const ShadeResult direct = meter.at({0, 0, 0}, {0, 0, 1}, Light::direct, 1 << 15);
    const ShadeResult indirect = meter.at({0, 0, 0}, {0, 0, 1}, Light::indirect, 1 << 15);
    EXPECT_LT(direct.mean.g, 0.95f * kPi);
    EXPECT_NEAR((direct.mean.g + indirect.mean.g) / kPi, 1, 0.005);
}

// A point and a lamp of 4 cm that shines straight down as it does, over a small piece of ground
// glass: the first is found by light samples alone, the second by chance too. The lamp's cosine
// costs it 1 % and deviations of the means are below 1 %.
TEST(Materials, GroundGlassSpreadsALampAsItSpreadsAPoint) {
    for (const bool thin : {true, false}) {
        const auto room = [&](bool lamp_is_point) {
            Scene scene;
            const MaterialId ground = add_glossy(scene, Rgb(0.9f), glass(0.6f, thin));
            if (thin)
                add_quad(scene, {-0.15f, -0.15f, 1}, {0.3f, 0, 0}, {0, 0.3f, 0}, ground);
            else
                add_box(scene, {-0.15f, -0.15f, 1}, {0.15f, 0.15f, 1.1f}, ground);
            if (lamp_is_point)
                scene.lights = {point_light({0, 0, 2}, Rgb(100))};
            else
                add_quad(scene, {-0.02f, -0.02f, 2}, {0, 0.04f, 0}, {0.04f, 0, 0},
                         add_material(scene, Rgb(0), Rgb(62'500)));
            return scene;
        };
        const Meter point(room(true)), lamp(room(false));
        for (const float x : {0.0f, 0.4f}) {
            const float a = point.lux({x, 0, 0}, {0, 0, 1}, Light::indirect, 1 << 19);
            const float b = lamp.lux({x, 0, 0}, {0, 0, 1}, Light::indirect, 1 << 19);
            EXPECT_GT(a, 0.1f) << thin;

            EXPECT_NEAR(a / b, 1, 0.04) << thin << " " << x;
        }
    }
}

}  // namespace
}  // namespace chiaro::tiny
