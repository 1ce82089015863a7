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

// A direction that is sampled has a density above 0, also from the rim of the square and about
// shading normals that lean far from the surface: else a path would divide 0 by 0 where no light
// sampling could have found the same.
TEST(Sampling, SampledDirectionsHaveADensity) {
    const float last = 0x1.fffffep-1f;
    Rng rng(2);
    std::vector<Vec2> places;
    for (const float edge : {0.0f, 0.5f, last})
        for (const float along : {0.0f, 0.25f, 0.5f, last, rng.uniform()}) {
            places.push_back({edge, along});
            places.push_back({along, edge});
        }
    for (const Vec2 u : places) {
        EXPECT_GT(square_to_cosine_hemisphere(u).z, 0) << u.x << " " << u.y;
        EXPECT_NEAR(glm::length(square_to_cosine_hemisphere(u)), 1, 1e-6f);
    }
    for (int i = 0; i < 1000; ++i) {
        const Vec3 up = glm::normalize(Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.4f);
        Vec3 leaning = glm::normalize(Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5f);
        if (glm::dot(leaning, up) < 0) leaning = -leaning;
        for (const Vec3 shading : {up, leaning}) {
            const Receiver receiver = {Vec3(0), Vec3(0), up, shading};
            for (const Vec2 u : places) {
                const Vec3 w = sample_receiving_cosine(receiver, u);
                EXPECT_GT(pdf_receiving_cosine(receiver, w), 0);
            }
        }
    }
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
// errors over seeds 0.4 and 0.11 %; bounds 5 of them, false alarm 6e-7 each.
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
        Rgb through(0);
        if (c) meter.caster.transmittance({&c->shadow_ray, 1}, {&through, 1});
        if (c) by_light += (through * c->irradiance).r / kSamples;
        const Vec3 d = square_to_cosine_hemisphere({rng.uniform(), rng.uniform()});
        const Hit hit = meter.look(receiver.origin, d);
        if (hit) by_cosine += kPi * emission(meter.scene, hit.point, hit.front).r / kSamples;
    }
    const float weighted = meter.at(Vec3(0), up, Light::direct, 1 << 17).mean.r;
    EXPECT_NEAR(by_light / by_cosine, 1, 0.02);
    EXPECT_NEAR(weighted / by_cosine, 1, 0.006);
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
        EXPECT_NEAR(pdf_cosine_hemisphere(d.z) / c->pdf_cosine(), 1, 2e-3);
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

// What paths do eight at a time is what they do one by one: the same light samples from the same
// numbers, and the same next directions.
TEST(Sampling, EightLightSamplesAreEightTimesOne) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(0.5f));
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(3, 2, 1));
    tiny::add_quad(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, white);
    for (int i = 0; i < 20; ++i)
        tiny::add_quad(scene, {0.4f * float(i) - 4, 3, -1}, {0.3f, 0, 0}, {0, 0.1f, 0.3f}, lamp);
    const RayCaster caster(scene, 1);
    const AreaLights area_lights(scene);
    const LitScene lit = make_lit_scene(scene, caster, area_lights);

    Rng rng(5);
    int found = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Vec3 position(4 * rng.uniform() - 2, 2 * rng.uniform(), 4 * rng.uniform() - 2);
        const Vec3 up = glm::normalize(Vec3(rng.uniform(), 1, rng.uniform()) - 0.5f);
        const Vec3 leaning = glm::normalize(up + Vec3(0.3f * rng.uniform(), 0, 0));
        const Receiver receiver = make_receiver(caster, ObjectId{0}, position, up, leaning);
        Lanes3 numbers;
        for (int i = 0; i < kLanes; ++i)
            numbers.set(i, {rng.uniform(), rng.uniform(), rng.uniform()});
        const Vec3x8 u = numbers.all();
        const LightConnections8 eight =
            connect_area_light(lit, everywhere(receiver), u.x, {u.y, u.z}, 0x7f);
        const Lanes3 to_light(eight.shadow_direction), irradiance(eight.irradiance);
        const Lanes3 directions(sample_receiving_cosine(everywhere(receiver), Vec2x8{u.y, u.z}));
        EXPECT_EQ(eight.found & 0x80, 0u);  // was not asked for
        for (int i = 0; i < kLanes; ++i) {
            const Vec3 n = numbers.lane(i);
            const Vec3 direction = sample_receiving_cosine(receiver, Vec2(n.y, n.z));
            EXPECT_LT(glm::distance(directions.lane(i), direction), 1e-5f);
            const auto one = connect_area_light(lit, receiver, n.x, {n.y, n.z});
            if (i == 7) continue;
            ASSERT_EQ((eight.found >> i & 1) != 0, one.has_value());
            if (!one) continue;
            ++found;
            EXPECT_LT(glm::distance(to_light.lane(i), one->shadow_ray.direction), 1e-5f);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(irradiance.lane(i)[c], one->irradiance[c], 1e-4f * one->irradiance[c]);
        }
    }
    EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace chiaro
