// The sampler of surfaces against its density, and both against odd input.
#include "base/random.h"
#include "scene/bsdf_testing.h"
#include "scene/chi_squared.h"

#include <gtest/gtest.h>

#include <limits>

namespace chiaro {
namespace {

// The walks that end are one more cell.
void expect_density_as_stated(const Bsdf& b, float cosine, const std::string& name) {
    const Vec3 from = direction(cosine, 0.7f);
    Rng rng(23);
    const auto draw = [&]() -> std::optional<Vec3> {
        const float u_lobe = rng.uniform(), u = rng.uniform();
        const auto s = sample_bsdf(b, from, u_lobe, {u, rng.uniform()});
        if (!s) return std::nullopt;
        return s->direction;
    };
    expect_density(
        [&](Vec3 to) { return pdf_bsdf(b, from, to); }, draw,
        name + ", alpha " + std::to_string(b.alpha) + ", cosine " + std::to_string(cosine));
}

constexpr float kRoughnesses[] = {0.25f, 0.5f, 1};
constexpr float kCosines[] = {0.05f, 0.4f, 0.95f};

TEST(BsdfSampling, MetalFollowsItsDensity) {
    for (const float roughness : kRoughnesses)
        for (const float cosine : kCosines)
            expect_density_as_stated(metal(roughness), cosine, "metal");
}

TEST(BsdfSampling, PlasticFollowsItsDensity) {
    for (const float roughness : kRoughnesses)
        for (const float cosine : kCosines)
            expect_density_as_stated(plastic(roughness, Rgb(0.3f)), cosine, "plastic");
}

TEST(BsdfSampling, RoughGlassFollowsItsDensity) {
    for (const float roughness : kRoughnesses)
        for (const float cosine : kCosines)
            for (const float eta : {1.5f, 1 / 1.5f})
                expect_density_as_stated(solid(roughness, eta), cosine, "glass");
}

TEST(BsdfSampling, ARoughPaneFollowsItsDensity) {
    for (const float roughness : kRoughnesses)
        for (const float cosine : kCosines) {
            expect_density_as_stated(pane(roughness, {1, 0.5f, 0.2f}), cosine, "pane");
            Bsdf mixed = plastic(roughness);
            mixed.glass = 0.5f;
            expect_density_as_stated(mixed, cosine, "part of a pane");
        }
}

// Where there are deltas too, the density is that of the rest: it integrates to the rest's share.
TEST(BsdfSampling, TheDensityLeavesOutDeltas) {
    const Bsdf b = plastic(0, Rgb(0.5f));
    const Vec3 from = direction(0.4f);
    int rest = 0;
    Rng rng(3);
    for (int i = 0; i < 100'000; ++i)
        rest += !sample_bsdf(b, from, rng.uniform(), {rng.uniform(), rng.uniform()})->delta();
    const float density = integrate_sphere(100, [&](Vec3 w) { return pdf_bsdf(b, from, w); });
    EXPECT_NEAR(rest / 1e5, density, 6 * 0.0016);  // standard error 0.0016
    EXPECT_LT(density, 0.95f);
}

// A weight is the value times the cosine over the density, the roles given by what is carried.
TEST(BsdfSampling, WeightsAreValueTimesCosineOverDensity) {
    Rng rng(4);
    for (const Bsdf& b : {metal(0.3f), plastic(0.6f), solid(0.4f, 1.5f), pane(0.2f)})
        for (int i = 0; i < 2000; ++i) {
            const Vec3 from = direction(0.01f + 0.99f * rng.uniform(), 9 * rng.uniform());
            const auto transport = i % 2 == 0 ? Transport::radiance : Transport::importance;
            const auto s =
                sample_bsdf(b, from, rng.uniform(), {rng.uniform(), rng.uniform()}, transport);
            if (!s) continue;
            const Vec3 to = s->direction;
            const bool to_light = transport == Transport::radiance;
            const Rgb value = to_light ? eval_bsdf(b, from, to) : eval_bsdf(b, to, from);
            EXPECT_NEAR(s->pdf, pdf_bsdf(b, from, to), 1e-5f * s->pdf);
            EXPECT_NEAR(s->weight.g, value.g * std::abs(to.z) / s->pdf, 1e-4f * s->weight.g);
            EXPECT_NEAR(glm::length(to), 1, 1e-5f);
            EXPECT_EQ(s->lobe == Lobe::transmission, to.z < 0);
        }
}

// Whatever the directions and parameters, numbers stay finite and not negative.
TEST(BsdfSampling, OddDirectionsGiveNumbers) {
    Rng rng(9);
    const float small = std::numeric_limits<float>::denorm_min();
    const float heights[] = {0, small, 1e-30f, 1e-12f, 1e-7f, 1e-4f, 0.5f, 0.9999999f, 1};
    const auto odd = [&] {
        Vec3 w = direction(heights[rng.below(9)], 1e-4f * float(rng.below(70000)));
        if (rng.below(2) == 0) w.z = -w.z;
        return w;
    };
    const auto fine = [](Rgb c) {
        return is_finite(c) && glm::all(glm::greaterThanEqual(c, Rgb(0)));
    };
    for (int i = 0; i < 60'000; ++i) {
        Bsdf b = plastic(rng.below(3) == 0 ? 0.03f : rng.uniform());
        b.glass = float(rng.below(3)) / 2;
        b.tint = Rgb(float(rng.below(2)));
        b.thin = rng.below(2) == 0;
        const float etas[] = {1.01f, 1.5f, 3, 1 / 1.01f, 1 / 1.5f, 1 / 3.0f};
        b.eta = etas[b.thin ? rng.below(3) : rng.below(6)];
        const Vec3 v = odd(), w = odd();
        EXPECT_TRUE(fine(eval_bsdf(b, v, w)));
        EXPECT_TRUE(fine(eval_bsdf(b, v, v)));
        const float density = pdf_bsdf(b, v, w);
        EXPECT_TRUE(density >= 0 && density < kInfinity);
        const float largest = 0x1.fffffep-1f;
        const float u[] = {0, largest, rng.uniform()};
        const auto s = sample_bsdf(b, v, u[rng.below(3)], {u[rng.below(3)], u[rng.below(3)]});
        if (!s) continue;
        EXPECT_TRUE(fine(s->weight) && is_finite(s->direction)) << i;
        EXPECT_TRUE(s->pdf >= 0 && s->pdf < kInfinity) << i;
    }
}

// A walk on a black surface ends or weighs nothing.
TEST(BsdfSampling, BlackGivesNothing) {
    const auto black = sample_bsdf(Bsdf(), {0, 0, 1}, 0.5f, {0.5f, 0.25f});
    EXPECT_TRUE(!black || black->weight == Rgb(0));
    EXPECT_FALSE(sample_bsdf(metal(0.5f), {1, 0, 0}, 0.5f, {0.5f, 0.5f}));
    EXPECT_FALSE(sample_bsdf(metal(0.5f), {0, 0, -1}, 0.5f, {0.5f, 0.5f}));
}

}  // namespace
}  // namespace chiaro
