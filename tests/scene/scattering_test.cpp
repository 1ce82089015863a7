// Surfaces whose shading normal is not that of their real plane.
#include "scene/scattering.h"

#include "base/random.h"
#include "scene/chi_squared.h"

namespace chiaro {
namespace {

// The real plane is z = 0; the shading normal leans by 0.5 toward +x, and directions come
// from between the two planes, too.
constexpr float kLean = 0.5f;

Scattering leaning(const Bsdf& b, float cosine, float azimuth) {
    return make_scattering(b, {0, 0, 1}, {std::sin(kLean), 0, std::cos(kLean)},
                           direction(cosine, azimuth));
}

std::vector<std::pair<std::string, Bsdf>> surfaces() {
    return {{"metal", metal(0.4f)},
            {"plastic", plastic(0.3f)},
            {"glass", solid(0.4f, 1.5f)},
            {"glass from inside", solid(0.4f, 1 / 1.5f)},
            {"pane", pane(0.5f)},
            {"mirror", metal(0)},
            {"clear glass", solid(0, 1.5f)},
            {"lacquer", plastic(0, Rgb(0.6f))},
            {"clear pane", pane(0, Rgb(0.5f))}};
}

// False alarm below 1e-6 each, as expect_density() says.
TEST(Scattering, DirectionsFollowTheirDensity) {
    for (const auto& [name, b] : surfaces()) {
        if (is_delta_only(b)) continue;
        for (const auto& [cosine, azimuth] : {std::pair{0.05f, 0.3f}, {0.7f, 3.0f}}) {
            const Scattering s = leaning(b, cosine, azimuth);
            Rng rng(5);
            const auto draw = [&]() -> std::optional<Vec3> {
                const float u_lobe = rng.uniform(), u = rng.uniform();
                const auto found = sample_scattering(s, u_lobe, {u, rng.uniform()});
                if (!found || found->delta()) return std::nullopt;
                return found->direction;
            };
            expect_density([&](Vec3 to) { return pdf_scattering(s, to); }, draw, name, 48);
        }
    }
}

TEST(Scattering, WhatReflectsStaysAboveTheRealPlaneAndWhatPassesIsBelow) {
    Rng rng(6);
    for (const auto& [name, b] : surfaces())
        for (int i = 0; i < 2000; ++i) {
            const Scattering s = leaning(b, 0.02f + 0.98f * rng.uniform(), 6 * rng.uniform());
            const float u_lobe = rng.uniform(), u = rng.uniform();
            const auto found = sample_scattering(s, u_lobe, {u, rng.uniform()});
            if (!found) continue;
            EXPECT_EQ(found->direction.z > 0, found->lobe != Lobe::transmission) << name;
            EXPECT_NEAR(glm::length(found->direction), 1, 1e-5) << name;
        }
}

// The sampler and the value agree: both integrals over directions are one. 2e5 samples of weights
// of deviation below 1.5: an error of 0.02 is 6 deviations.
TEST(Scattering, NoLightIsLostWhereNormalsLean) {
    for (const auto& [name, b] : {std::pair{"metal", metal(0.5f)}, {"plastic", plastic(0.4f)}})
        for (const float cosine : {0.4f, 0.95f}) {
            const Scattering s = leaning(b, cosine, 3.0f);
            const Rgb seen =
                integrate_sphere(128, [&](Vec3 to) -> Rgb { return scattered(s, to); });
            EXPECT_NEAR(seen.g, 1, 0.02) << name << " " << cosine;
            Rng rng(7);
            double sum = 0;
            for (int i = 0; i < 200'000; ++i) {
                const float u_lobe = rng.uniform(), u = rng.uniform();
                const auto found = sample_scattering(s, u_lobe, {u, rng.uniform()});
                if (found) sum += double(found->weight.g) / 200'000;
            }
            EXPECT_NEAR(sum, 1, 0.02) << name << " " << cosine;
        }
}

// Each branch of a smooth surface is what chance gives in the mean. False alarm below 1e-6: the
// weights of a kind are all alike, and the bound is 6 deviations of a count.
TEST(Scattering, SmoothPartsAreTheMeanOfSamples) {
    for (const auto& [name, b] : surfaces()) {
        if (!b.smooth()) continue;
        const Scattering s = leaning(b, 0.6f, 2.0f);
        const SmoothParts parts = smooth_parts(s);
        Rng rng(8);
        double reflected = 0, transmitted = 0;
        constexpr int kSamples = 100'000;
        for (int i = 0; i < kSamples; ++i) {
            const float u_lobe = rng.uniform(), u = rng.uniform();
            const auto found = sample_scattering(s, u_lobe, {u, rng.uniform()});
            if (!found || !found->delta()) continue;
            const bool passes = found->lobe == Lobe::transmission;
            (passes ? transmitted : reflected) += double(found->weight.g) / kSamples;
            const Vec3 expected = passes ? parts.transmitted_from : parts.reflected_from;
            EXPECT_LT(glm::distance(found->direction, expected), 1e-5) << name;
        }
        const double bound = 6 * std::sqrt(0.25 / kSamples) * 1.5;
        EXPECT_NEAR(parts.reflected.g, reflected, bound) << name;
        EXPECT_NEAR(parts.transmitted.g, transmitted, bound) << name;
    }
}

}  // namespace
}  // namespace chiaro
