// Samplers against their densities, and techniques against each other.
#include "sample_renderer/direct_light.h"
#include "sample_renderer/meter.h"
#include "sample_renderer/warp.h"

#include <gtest/gtest.h>

#include <array>

namespace chiaro {
namespace {

using tiny::Meter;

// Chi^2 of cosine-distributed directions in 10 x 16 cells of equal probability (cos^2 and azimuth).
// 160 cells: mean 159, standard deviation 18; bound 159 + 6 x 18, false alarm about 1e-7.
TEST(Sampling, CosineHemisphereChiSquared) {
    std::array<double, 160> counts = {};
    constexpr int kSamples = 320'000;
    Rng rng(1);
    for (int i = 0; i < kSamples; ++i) {
        const Vec3 d = square_to_cosine_hemisphere({rng.uniform(), rng.uniform()});
        EXPECT_NEAR(glm::length(d), 1, 1e-5f);
        const double azimuth = (std::atan2(d.y, d.x) + kPi) / (2 * kPi);
        const int ring = std::min(9, int(d.z * d.z * 10));
        counts[ring * 16 + std::min(15, int(azimuth * 16))] += 1;
    }
    double chi2 = 0;
    for (const double n : counts)
        chi2 += (n - kSamples / 160.0) * (n - kSamples / 160.0) / (kSamples / 160.0);
    EXPECT_LT(chi2, 159 + 6 * 18);
}

// The density integrates to 1 over the hemisphere: mean of pdf x 2 pi over even directions.
TEST(Sampling, CosineDensityIntegratesToOne) {
    double sum = 0;
    for (int i = 0; i < 1000; ++i)
        sum += pdf_cosine_hemisphere((float(i) + 0.5f) / 1000) * 2 * kPi / 1000;
    EXPECT_NEAR(sum, 1, 1e-5);
}

// Lights are chosen with the probabilities that the choice states, and those follow the power.
TEST(Sampling, LightChoiceStatesItsProbabilities) {
    Scene scene;
    tiny::add_quad(scene, Vec3(0), {1, 0, 0}, {0, 1, 0}, tiny::add_material(scene, Rgb(0), Rgb(8)));
    for (const float candela : {1.0f, 0.0f, 3.0f})
        scene.lights.push_back(tiny::point_light({0, 0, 1}, Rgb(candela)));
    const AreaLights area(scene);
    const LightChoice choice(scene, area, 1);
    constexpr int kSteps = 100'000;
    std::array<int, 4> counts = {};
    std::array<float, 4> stated = {};
    for (int i = 0; i < kSteps; ++i) {
        const auto c = choice.sample((float(i) + 0.5f) / kSteps);
        ++counts[c.punctual + 1];
        stated[c.punctual + 1] = c.probability;
        EXPECT_TRUE(c.rest >= 0 && c.rest < 1);
    }
    EXPECT_NEAR(stated[0] / stated[1], 2, 1e-4);  // pi x 8 against 4 pi x 1
    EXPECT_NEAR(stated[3] / stated[1], 3, 1e-4);
    EXPECT_EQ(counts[2], 0);
    for (const int i : {0, 1, 3}) EXPECT_NEAR(counts[i], stated[i] * kSteps, 2);
    EXPECT_EQ(choice.probability_of_area_lights(), stated[0]);
}

// A lamp large and near, so that each technique matters, half hidden by a sheet.
Scene near_lamp() {
    Scene scene;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1));
    tiny::add_quad(scene, {-1, -1, 0.4f}, {0, 2, 0}, {3, 0, 0.3f}, lamp);
    tiny::add_quad(scene, {-0.3f, -1, 0.2f}, {0, 2, 0}, {0.2f, 0, 0},
                   tiny::add_material(scene, Rgb(0)));
    return scene;
}

// The weighted estimate has the mean that light samples alone and cosine rays alone have. Standard
// errors below 0.2 %; bound 1 %.
TEST(Sampling, WeightedEqualsEachTechniqueAlone) {
    const Meter meter(near_lamp());
    const Vec3 up(0, 0, 1);
    const Receiver receiver = {Vec3(0), {0, 0, 1e-5f}, up, up};
    constexpr int kSamples = 400'000;
    double by_light = 0, by_cosine = 0;
    Rng rng(5);
    for (int i = 0; i < kSamples; ++i) {
        const auto c =
            connect_area_light(meter.lit, receiver, rng.uniform(), {rng.uniform(), rng.uniform()});
        std::uint8_t blocked = 1;
        if (c) meter.caster.occluded({&c->shadow_ray, 1}, {&blocked, 1});
        if (!blocked) by_light += c->irradiance.r / kSamples;
        const Vec3 d = square_to_cosine_hemisphere({rng.uniform(), rng.uniform()});
        const Hit hit = meter.look(receiver.origin, d);
        if (hit) by_cosine += kPi * emission(meter.scene, hit.point, hit.front).r / kSamples;
    }
    const float weighted = meter.at(Vec3(0), up, Light::direct, 1 << 17).mean.r;
    EXPECT_NEAR(by_light / by_cosine, 1, 0.01);
    EXPECT_NEAR(weighted / by_cosine, 1, 0.005);
}

// The density that MIS gives a ray's hit is the one that the light sampler states of the same
// direction.
TEST(Sampling, BothTechniquesStateTheSameDensity) {
    const Meter meter(near_lamp());
    const Receiver receiver = {Vec3(0), {0, 0, 1e-5f}, {0, 0, 1}, {0, 0, 1}};
    Rng rng(6);
    int compared = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto c =
            connect_area_light(meter.lit, receiver, rng.uniform(), {rng.uniform(), rng.uniform()});
        if (!c) continue;
        const Vec3 d = glm::normalize(c->shadow_ray.direction);
        const Hit hit = meter.look(receiver.origin, d);
        if (!hit || hit.point.object != ObjectId(0)) continue;
        EXPECT_NEAR(pdf_area_light(meter.lit, lit_place(receiver), d, hit) / c->pdf_solid_angle, 1,
                    2e-3);
        EXPECT_NEAR(pdf_cosine_hemisphere(d.z) / c->pdf_cosine, 1, 2e-3);
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

// Twenty sources, more than are asked one by one: the choice by power has the mean of their sum.
// Standard error 0.3 %; bound 2 %.
TEST(Sampling, ManyPunctualLightsAreChosenByPower) {
    Scene scene;
    tiny::add_quad(scene, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0},
                   tiny::add_material(scene, Rgb(0.5f)));
    Rng rng(7);
    double expected = 0;
    for (int i = 0; i < 20; ++i) {
        const Vec3 p(4 * rng.uniform() - 2, 4 * rng.uniform() - 2, 2 + rng.uniform());
        const float candela = 1 + rng.uniform();
        scene.lights.push_back(tiny::point_light(p, Rgb(candela)));
        expected += candela * p.z / std::pow(double(glm::dot(p, p)), 1.5);
    }
    const Meter meter(scene);
    const ShadeResult found = meter.at(Vec3(0), {0, 0, 1}, Light::direct, 1 << 15);
    EXPECT_NEAR(found.mean.r / expected, 1, 0.02);
    EXPECT_GT(found.variance.r, 0);
}

}  // namespace
}  // namespace chiaro
