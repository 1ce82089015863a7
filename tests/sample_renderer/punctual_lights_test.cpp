// The choice among many lamps and suns: its stated chances, and that it starves none of them.
#include "sample_renderer/meter.h"
#include "scene/chi_squared.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace chiaro {
namespace {

using tiny::Meter;

constexpr std::uint32_t kLamps = 200;

Vec3 random_direction(Rng& rng) {
    const float z = 2 * rng.uniform() - 1, azimuth = 2 * kPi * rng.uniform();
    const float r = std::sqrt(1 - z * z);
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

// Points and spots anywhere in a cube of 4, some a thousand times as bright as others.
Scene lamps(std::uint32_t count = kLamps) {
    Scene scene;
    Rng rng(3);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 place = 4.0f * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 2.0f;
        const float candela = std::pow(1000.0f, rng.uniform());
        PunctualLight light = tiny::point_light(place, candela * Rgb(1, 2, 3));
        light.direction = random_direction(rng);
        light.outer_cone = 0.05f + 1.5f * rng.uniform();
        light.inner_cone = light.outer_cone * rng.uniform();
        if (i % 2 == 0) light.kind = LightKind::spot;
        scene.lights.push_back(light);
    }
    return scene;
}

std::vector<LitPlace> places() {
    std::vector<LitPlace> places = {{{0, 0, -2.5f}, {0, 0, 1}}, {{9, 1, 1}, {-1, 0, 0}}};
    Rng rng(4);
    for (int i = 0; i < 6; ++i)
        places.push_back({3.0f * random_direction(rng) * rng.uniform(), random_direction(rng)});
    return places;
}

// Chi^2 of choices against the stated chances, with finding no lamp; false alarm below 1e-6 at each
// of 8 places.
TEST(PunctualLights, FrequenciesAreTheChancesStated) {
    const Scene scene = lamps();
    const PunctualLights lights(scene);
    constexpr int kSamples = 200'000;
    Rng rng(5);
    for (const LitPlace& place : places()) {
        std::vector<double> counts(kLamps + 1, 0.0), expected;
        for (int i = 0; i < kSamples; ++i) {
            const auto chosen = lights.sample_lamp(place, rng.uniform());
            counts[chosen ? chosen->light : kLamps] += 1;
            if (!chosen) continue;
            EXPECT_NEAR(chosen->probability / lights.lamp_chance(place, chosen->light), 1, 1e-5);
        }
        double none = kSamples;
        for (std::uint32_t i = 0; i < kLamps; ++i) {
            expected.push_back(kSamples * double(lights.lamp_chance(place, i)));
            none -= expected[i];
        }
        expected.push_back(std::max(none, 0.0));
        expect_counts(counts, expected, "lamps");
    }
}

// No lamp is chosen with less than a tenth of an even chance, and one that does not shine on a
// place with no more than that: below the horizon, or outside of a spot's cone (a milliradian
// aside).
TEST(PunctualLights, NoneIsStarvedAndTheDarkAreSeldomAsked) {
    const Scene scene = lamps();
    const PunctualLights lights(scene);
    constexpr float kLeast = PunctualLights::kEvenPart / kLamps;
    int dark = 0;
    for (const LitPlace& place : places()) {
        std::vector<float> chances(kLamps, 0.0f);
        for (int i = 0; i < 100'000; ++i)
            if (const auto chosen = lights.sample_lamp(place, (float(i) + 0.5f) / 100'000))
                chances[chosen->light] = chosen->probability;
        for (std::uint32_t i = 0; i < kLamps; ++i) {
            EXPECT_GE(chances[i], kLeast) << i;
            PunctualLight wider = scene.lights[i];
            wider.outer_cone += 1e-3f;
            const auto arrives = arrival(wider, place.position);
            if (arrives && glm::dot(arrives->to_light, place.normal) > 0) continue;
            EXPECT_LE(chances[i], 1.0001f * kLeast) << i;
            ++dark;
        }
    }
    EXPECT_GT(dark, 800);
}

// The chances of 40 lamps, all of which shine on the place, sum to 1.
TEST(PunctualLights, ChancesSumToOne) {
    Scene scene = lamps(40);
    for (PunctualLight& light : scene.lights) light.kind = LightKind::point;
    const PunctualLights lights(scene);
    std::array<double, 40> chances = {};
    for (int i = 0; i < 100'000; ++i) {
        const auto chosen =
            lights.sample_lamp({{0, 0, -3}, {0, 0, 1}}, (float(i) + 0.5f) / 100'000);
        ASSERT_TRUE(chosen);
        chances[chosen->light] = chosen->probability;
    }
    double sum = 0;
    for (const double chance : chances) sum += chance;
    EXPECT_NEAR(sum, 1, 1e-5);
}

// A cube of 4 m, all faces 0.5, with a lamp of 100 cd in its middle: indirect light of 14.08 lux in
// the middle of the floor (CIE 171, 5.8: 112.04 lux for 10 000 lm).
Scene lit_cube() {
    Scene scene;
    tiny::add_room(scene, Vec3(-2), Vec3(2), tiny::add_material(scene, Rgb(0.5f)));
    scene.lights.push_back(tiny::point_light(Vec3(0), Rgb(100)));
    return scene;
}
constexpr double kCubeLux = 112.04 * 400 * kPi / 10'000;

// A sun on a large ground outside, and a searchlight hidden in a box, take nothing from the lamp
// inside, whichever the seed. Standard errors over seeds 0.2 and 0.6 %, as of one choice in twenty;
// bounds at least 5 of them, false alarm 6e-7 a number.
TEST(PunctualLights, BrightLightsElsewhereTakeNothingFromALamp) {
    Scene outside = lit_cube();
    tiny::add_quad(outside, {-50, -50, -2.5f}, {100, 0, 0}, {0, 100, 0}, MaterialId(0));
    outside.lights.push_back(tiny::sun({0.3f, 0.2f, -1}, Rgb(1e5f)));
    Scene hidden = lit_cube();
    tiny::add_room(hidden, Vec3(5), Vec3(6), MaterialId(0));
    hidden.lights.push_back(tiny::point_light(Vec3(5.5f), Rgb(1e12f)));
    const Meter beside_sun(outside), beside_searchlight(hidden);
    for (const std::uint32_t seed : {1, 2, 3}) {
        const auto lux = [seed](const Meter& meter) {
            return meter.at({0, 0, -2}, {0, 0, 1}, Light::indirect, 1 << 17, seed).mean.g;
        };
        EXPECT_NEAR(lux(beside_sun) / kCubeLux, 1, 0.015) << seed;
        EXPECT_NEAR(lux(beside_searchlight) / kCubeLux, 1, 0.04) << seed;
    }
}

// Forty lamps and two suns in a court with a block; `alone` shines by itself, or all if it is 42.
constexpr std::uint32_t kAll = 42;
Scene court(std::uint32_t alone) {
    Scene scene = lamps(40);
    for (PunctualLight& light : scene.lights) {
        light.position = Vec3(2, 2, 2) + 0.8f * light.position;
        light.intensity = glm::sqrt(light.intensity);
        light.outer_cone += 0.3f;
    }
    scene.lights.push_back(tiny::sun({0.2f, 0.4f, -1}, Rgb(20)));
    scene.lights.push_back(tiny::sun({-0.5f, 0.4f, -0.7f}, Rgb(10)));
    if (alone < kAll) scene.lights = {scene.lights[alone]};
    const MaterialId white = tiny::add_material(scene, Rgb(0.7f));
    Mesh walls = tiny::box_mesh(Vec3(0), Vec3(4), white, true);
    walls.primitives.erase(walls.primitives.begin() + 1);  // no ceiling
    tiny::add_object(scene, walls);
    tiny::add_box(scene, {1, 1, 0}, {2, 2.5f, 1.5f}, white);
    return scene;
}

// Light of all lamps and suns = the sum of each alone, in which no choice plays a part; more than
// are asked one by one, in direct light and after reflections. Standard errors over seeds 0.05 and
// 0.5 %, bounds more than 5 of them, false alarm 6e-7 each.
TEST(PunctualLights, ManyAreTheSumOfEachAlone) {
    const Vec3 place(3, 1.2f, 0), up(0, 0, 1);
    for (const Light light : {Light::direct, Light::indirect}) {
        const std::uint32_t samples = light == Light::direct ? 1 << 15 : 1 << 17;
        double sum = 0;
        for (std::uint32_t i = 0; i < kAll; ++i)
            sum += Meter(court(i)).at(place, up, light, samples / 16, i).mean.g;
        const ShadeResult all = Meter(court(kAll)).at(place, up, light, samples);
        EXPECT_NEAR(all.mean.g / sum, 1, light == Light::direct ? 0.005 : 0.03);
        EXPECT_GT(all.variance.g, 0);
    }
}

// Of two suns on a wall, the brighter one hidden, the other's light is found all the same: E cos =
// 2 lux; and one below the horizon is never asked.
TEST(PunctualLights, SunsAreChosenByWhatTheyBring) {
    Scene scene;
    scene.lights.push_back(tiny::sun({0, 0, -1}, Rgb(1e6f)));
    scene.lights.push_back(tiny::sun({0.6f, 0, -0.8f}, Rgb(2.5f)));
    scene.lights.push_back(tiny::sun({0, 0, 1}, Rgb(1e9f)));
    tiny::add_quad(scene, {-1, -1, 5}, {2, 0, 0}, {0, 2, 0}, tiny::add_material(scene, Rgb(0)));
    const Meter meter(scene);
    const Vec3 up(0, 0, 1);
    const Receiver receiver = {Vec3(0), {0, 0, 1e-5f}, up, up};
    double sum = 0;
    constexpr int kSteps = 20'000;
    for (int i = 0; i < kSteps; ++i) {
        const auto found = connect_sun(meter.lit, receiver, (float(i) + 0.5f) / kSteps);
        if (!found) continue;
        Rgb through;
        meter.caster.transmittance({&found->shadow_ray, 1}, {&through, 1});
        sum += (through * found->irradiance).g / kSteps;
    }
    EXPECT_NEAR(sum, 2, 0.01);
}

// A lamp in the very plane of the ceiling lights the room: 100 cd, 3 m above the floor.
TEST(PunctualLights, ALampInASurfaceShines) {
    Scene scene;
    tiny::add_room(scene, Vec3(-2), {2, 2, 3}, tiny::add_material(scene, Rgb(0)));
    scene.lights.push_back(tiny::point_light({0, 0, 3}, Rgb(100)));
    const Meter meter(scene);
    EXPECT_NEAR(meter.lux({0, 0, 0}, {0, 0, 1}, Light::direct, 4) * 9 / 100, 1, 1e-5);
}

}  // namespace
}  // namespace chiaro
