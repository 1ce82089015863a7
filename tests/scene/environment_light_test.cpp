// Samples of the environment against their density, and the density against the environment.
#include "scene/environment_light.h"

#include "base/random.h"
#include "scene/chi_squared.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

const LitPlace kSomewhere = {{0, 0, 0}, {0, 0, 1}};

Scene scene_with(const Image& map) {
    Scene scene;
    scene.environment.map = map;
    return scene;
}

// Dim colours, a hundred times as bright in some places.
Image blotched(int width, int height) {
    Image map(width, height);
    Rng rng(5);
    for (Rgb& pixel : map.pixels) {
        const Rgb color(rng.uniform(), rng.uniform(), rng.uniform());
        pixel = rng.below(40) == 0 ? 100.0f * color : color;
    }
    return map;
}

Image one_pixel(int width, int height, int x, int y, Rgb radiance, Rgb rest = Rgb(0)) {
    Image map(width, height);
    for (Rgb& pixel : map.pixels) pixel = rest;
    map.at(x, y) = radiance;
    return map;
}

// A sample from the whole sphere: one of two places sees each direction.
EnvironmentSample sample_anywhere(const EnvironmentLight& light, Rng& rng) {
    const float x = rng.uniform();
    const Vec2 u(x, rng.uniform());
    const auto above = light.sample(kSomewhere, u);
    return above ? *above : *light.sample({{0, 0, 0}, {0, 0, -1}}, u);
}

void expect_density_of(const Image& map, const char* name, int steps) {
    const Scene scene = scene_with(map);
    const EnvironmentLight light(scene);
    Rng rng(17);
    expect_density([&](Vec3 w) { return light.pdf(kSomewhere, w); },
                   [&] { return std::optional(sample_anywhere(light, rng).direction); }, name,
                   steps);
}

TEST(EnvironmentLight, SamplesOfAMapFollowTheirDensity) {
    expect_density_of(blotched(60, 30), "many pixels", 32);
    expect_density_of(blotched(3, 2), "six pixels", 32);
    expect_density_of(blotched(1, 1), "one pixel", 32);
    expect_density_of(blotched(16, 1), "one row", 32);
    expect_density_of(blotched(1, 40), "one column", 32);
    expect_density_of(one_pixel(64, 32, 63, 9, Rgb(1e5f), Rgb(1)), "a bright pixel", 64);
}

// Blocks of several cells, not all of one size: more than 2048 x 1024 pixels.
TEST(EnvironmentLight, SamplesOfALargeMapFollowTheirDensity) {
    Image map(4100, 40);
    for (int x = 0; x < map.width; ++x)
        for (int y = 0; y < map.height; ++y) {
            const float wave = std::sin(0.02f * float(x)) * std::cos(0.4f * float(y));
            map.at(x, y) = Rgb(1 + wave, x > 1000 && x < 1300 ? 9 : 0, 0);
        }
    expect_density_of(map, "wide", 64);
    Image tall(40, 2050);
    for (int x = 0; x < tall.width; ++x)
        for (int y = 0; y < tall.height; ++y) tall.at(x, y) = map.at(2 * y % 4100, x);
    expect_density_of(tall, "tall", 64);
}

TEST(EnvironmentLight, SamplesOfAnEvenSkyFollowTheCosineAtThePlace) {
    Scene scene;
    scene.environment.sky = {3, 2, 1};
    const EnvironmentLight light(scene);
    const LitPlace place = {{4, 5, 6}, glm::normalize(Vec3(1, -2, 0.5f))};
    Rng rng(9);
    expect_density([&](Vec3 w) { return light.pdf(place, w); },
                   [&] {
                       const float x = rng.uniform();
                       const auto s = light.sample(place, {x, rng.uniform()});
                       EXPECT_EQ(s->radiance, Rgb(3, 2, 1));
                       return std::optional(s->direction);
                   },
                   "even", 64);
}

// What a sample says of itself is what is known of its direction.
TEST(EnvironmentLight, SamplesAgreeWithTheMap) {
    const Scene scene = scene_with(blotched(50, 24));
    const EnvironmentLight light(scene);
    Rng rng(6);
    for (int i = 0; i < 20'000; ++i) {
        const EnvironmentSample s = sample_anywhere(light, rng);
        EXPECT_NEAR(glm::length(s.direction), 1, 1e-6f);
        const Rgb radiance = light.radiance(s.direction);
        EXPECT_LT(glm::length(radiance - s.radiance), 1e-3f + 1e-3f * glm::length(radiance));
        EXPECT_NEAR(light.pdf(kSomewhere, s.direction) / s.pdf, 1, 5e-3f);
    }
}

// The density of a map is as good as its brightness: estimates of a grey map's integral do not
// vary, be the sun's pixel large or small, in a small map or in a large one.
TEST(EnvironmentLight, ASunOfOnePixelLeavesNoNoise) {
    for (const auto& [width, height] :
         {std::pair(32, 16), std::pair(512, 256), std::pair(4096, 2048)}) {
        const Scene scene =
            scene_with(one_pixel(width, height, width / 3, height / 4, Rgb(1e9f), Rgb(0.01f)));
        const EnvironmentLight light(scene);
        Rng rng(8);
        double sum = 0, squares = 0;
        for (int i = 0; i < 1000; ++i) {
            const EnvironmentSample s = sample_anywhere(light, rng);
            const double estimate = double(s.radiance.g) / double(s.pdf);
            sum += estimate;
            squares += estimate * estimate;
        }
        // A pixel's solid angle; in a map of 16 rows the sine of its zenith angle is not one
        // number, which is all that varies.
        const double turn = 2 * double(kPi);
        const double size =
            turn / width * (turn / 2 / height) * std::sin(turn / 2 * (height / 4 + 0.5) / height);
        EXPECT_NEAR(sum / 1000 / (1e9 * size + 0.04 * double(kPi)), 1, 0.02);
        EXPECT_LT(squares / 1000 / (sum * sum / 1e6) - 1, 0.02);
    }
}

// Between a bright pixel and black ones, beyond the map's side, above its top row: where there is
// light there is density, and where there is none there is none.
TEST(EnvironmentLight, WhereThereIsLightThereIsDensity) {
    Rng rng(12);
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(7, 2), std::pair(3, 3)})
        for (const Rgb color : {Rgb(1), Rgb(0, 0, 1e-6f), Rgb(1e15f)}) {
            const Scene scene = scene_with(one_pixel(8, 4, x, y, color));
            const EnvironmentLight light(scene);
            int lit = 0;
            for (int i = 0; i < 3000; ++i) {
                const Vec3 w = direction(2 * rng.uniform() - 1, 7 * rng.uniform());
                const bool bright = max_component(light.radiance(w)) > 0;
                EXPECT_EQ(light.pdf(kSomewhere, w) > 0, bright);
                lit += bright;
            }
            EXPECT_GT(lit, 30);
            EXPECT_LT(lit, 1500);
        }
}

// Deep blue of no luminance is sampled too, and the poles give numbers.
TEST(EnvironmentLight, OddMapsAndNumbersGiveNumbers) {
    const float largest = 0x1.fffffep-1f;
    for (const Image& map :
         {one_pixel(8, 4, 2, 0, Rgb(1e15f)), one_pixel(8, 4, 2, 3, Rgb(1e-25f)),
          one_pixel(2, 1, 1, 0, Rgb(0, 0, 1)), one_pixel(5, 5, 1, 2, Rgb(1e15f), Rgb(1e-25f))}) {
        const Scene scene = scene_with(map);
        const EnvironmentLight light(scene);
        ASSERT_FALSE(light.empty());
        for (const float x : {0.0f, 0.3f, largest})
            for (const float y : {0.0f, 0.6f, largest})
                for (const float side : {1.0f, -1.0f}) {
                    const auto s = light.sample({{0, 0, 0}, {0, side, 0}}, {x, y});
                    if (!s) continue;
                    EXPECT_TRUE(is_finite(s->radiance) && is_finite(s->direction));
                    EXPECT_TRUE(s->pdf > 0 && s->pdf < kInfinity) << s->pdf;
                }
        for (const Vec3 pole : {Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
            const float pdf = light.pdf(kSomewhere, pole);
            EXPECT_TRUE(pdf >= 0 && pdf < kInfinity);
        }
    }
}

TEST(EnvironmentLight, ABlackOneIsEmpty) {
    Scene scene;
    EXPECT_TRUE(EnvironmentLight(scene).empty());
    EXPECT_EQ(EnvironmentLight(scene).pdf(kSomewhere, {0, 0, 1}), 0);
    scene.environment.map = Image(4, 2);
    EXPECT_TRUE(EnvironmentLight(scene).empty());
}

}  // namespace
}  // namespace chiaro
