// What surfaces give back: furnaces, reciprocity, and the special surfaces whose answers are known.
#include "scene/bsdf.h"

#include "base/random.h"
#include "scene/albedo_table.h"
#include "scene/bsdf_testing.h"
#include "scene/fresnel.h"
#include "scene/ggx.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

constexpr float kRoughnesses[] = {0, 0.03f, 0.1f, 0.22f, 0.5f, 0.86f, 1};
constexpr float kCosines[] = {0.05f, 0.13f, 0.42f, 0.8f, 1};

// In white surroundings all that absorbs nothing is white, and within the tables' error no more
// than that.
void expect_white(const Bsdf& b, const std::string& name) {
    for (const float cosine : kCosines) {
        const Rgb seen = furnace(b, cosine);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(seen[i], 1, 0.005) << name << " alpha " << b.alpha << " cosine " << cosine;
    }
}

TEST(Bsdf, WhiteMetalIsWhite) {
    for (const float roughness : kRoughnesses) expect_white(metal(roughness), "metal");
}

TEST(Bsdf, WhitePlasticIsWhite) {
    for (const float roughness : kRoughnesses) {
        expect_white(plastic(roughness), "plastic");
        expect_white(plastic(roughness, Rgb(1), {0.9f, 0.5f, 0.1f}), "lacquer");
        Bsdf even = plastic(roughness);
        even.f0 = even.f90 = Rgb(0.5f);
        expect_white(even, "gloss alike at all angles");
    }
}

TEST(Bsdf, ClearGlassIsWhiteFromBothSides) {
    for (const float roughness : kRoughnesses)
        for (const float eta : {1.33f, 2.4f, 1 / 1.5f})
            expect_white(solid(roughness, eta), "glass of " + std::to_string(eta));
}

TEST(Bsdf, AClearPaneIsWhite) {
    for (const float roughness : kRoughnesses) expect_white(pane(roughness), "pane");
}

TEST(Bsdf, AMixtureOfWhitesIsWhite) {
    for (const float roughness : kRoughnesses) {
        Bsdf b = plastic(roughness);
        b.glass = 0.4f;
        expect_white(b, "part of a pane");
    }
}

// Base, facets over it and facets of metal, as glTF mixes them.
Bsdf partly_metal(float roughness, float metallic, Rgb color) {
    Bsdf b = plastic(roughness, (1 - metallic) * color, glm::mix(Rgb(0.04f), color, metallic));
    b.metal = metallic;
    return b;
}

TEST(Bsdf, WhiteThatIsPartlyMetalIsWhite) {
    for (const float roughness : kRoughnesses)
        for (const float metallic : {0.2f, 0.9f})
            expect_white(partly_metal(roughness, metallic, Rgb(1)), "partly metal");
}

// What is half metal and half paint gives back half of what each does: exactly of smooth facets, on
// rough ones but for light that met facets of both.
TEST(Bsdf, PartlyMetalIsTheMixtureOfBoth) {
    const Rgb color(0.9f, 0.5f, 0.1f);
    for (const float roughness : {0.0f, 0.5f, 1.0f})
        for (const float cosine : kCosines) {
            const Bsdf mixed = partly_metal(roughness, 0.5f, color);
            const Rgb paint = total_albedo(plastic(roughness, color), cosine);
            const Rgb alone = total_albedo(metal(roughness, color), cosine);
            const Rgb difference = total_albedo(mixed, cosine) - 0.5f * (paint + alone);
            EXPECT_LE(max_component(glm::abs(difference)), roughness == 0 ? 1e-6f : 0.02f)
                << roughness << " " << cosine;
        }
}

// Facets are reciprocal: of the particles that a lamp sends, as many leave as come.
TEST(Bsdf, ClearSurfacesLoseNoParticles) {
    for (const float roughness : {0.0f, 0.3f, 1.0f})
        for (const Bsdf& b : {metal(roughness), pane(roughness), solid(roughness, 1.5f),
                              solid(roughness, 1 / 1.5f)})
            for (const float cosine : {0.13f, 0.8f})
                EXPECT_NEAR(furnace(b, cosine, 1 << 15, Transport::importance).g, 1, 0.005)
                    << b.eta << " alpha " << b.alpha << " cosine " << cosine;
}

// Nothing gives back more than it gets, whatever its parameters. 120 surfaces at random.
TEST(Bsdf, NothingGivesBackMoreThanItGets) {
    Rng rng(11);
    const auto rgb = [&] { return Rgb(rng.uniform(), rng.uniform(), rng.uniform()); };
    for (int i = 0; i < 120; ++i) {
        Bsdf b = plastic(rng.uniform(), rgb());
        b.f90 = rgb();
        b.f0 = b.f90 * rng.uniform();
        if (i % 5 == 0) b = partly_metal(rng.uniform(), rng.uniform(), rgb());
        b.tint = rgb();
        b.glass = i % 3 == 0 ? 0.0f : rng.uniform();
        b.thin = i % 2 == 0;
        b.eta = 1.1f + 1.9f * rng.uniform();
        if (i % 4 == 1) b.eta = 1 / b.eta;
        const float cosine = 0.05f + 0.95f * rng.uniform();
        const Rgb seen = furnace(b, cosine, 1 << 14);
        EXPECT_LE(max_component(seen), 1.005f) << i;
        const Rgb about = total_albedo(b, cosine);
        EXPECT_LE(max_component(about), 1.0001f) << i;
        if (b.glass == 0) {
            EXPECT_LE(max_component(glm::abs(about - seen)), 0.006f) << i;
        }
    }
}

// The sum of what eval_bsdf() says over all directions is what the sampler's weights say.
TEST(Bsdf, ValuesSumUpToTheFurnace) {
    for (const Bsdf& b : {metal(0.4f, {1, 0.6f, 0.2f}), plastic(0.4f, Rgb(0.3f)), solid(0.5f, 1.5f),
                          solid(0.5f, 1 / 1.5f), pane(0.4f, {1, 0.5f, 0})})
        for (const float cosine : {0.2f, 0.7f}) {
            const Vec3 to_eye = direction(cosine, 0.3f);
            const Rgb sum = integrate_sphere(180, [&](Vec3 w) {
                const float index = w.z < 0 && !b.thin ? b.eta * b.eta : 1.0f;
                return eval_bsdf(b, to_eye, w) * (std::abs(w.z) * index);
            });
            EXPECT_LE(max_component(glm::abs(sum - furnace(b, cosine))), 0.003f) << cosine;
        }
}

// What multiplies irradiance depends on the eye alone: diffuse radiance under any light is
// diffuse_albedo / pi, and the specular surface has all the rest.
TEST(Bsdf, DiffuseLightIsACachedIrradianceTimesAFactorOfTheEye) {
    Rng rng(5);
    for (int i = 0; i < 1000; ++i) {
        Bsdf b = plastic(rng.uniform(), {0.8f, 0.5f, 0.2f});
        b.glass = i % 2 == 0 ? 0.0f : 0.3f;
        const Vec3 to_eye = direction(0.01f + 0.99f * rng.uniform(), rng.uniform());
        const Vec3 to_light = direction(0.01f + 0.99f * rng.uniform(), 9 * rng.uniform());
        const Rgb diffuse =
            eval_bsdf(b, to_eye, to_light) - eval_bsdf(specular_only(b), to_eye, to_light);
        const Rgb expected = diffuse_albedo(b, to_eye.z) / kPi;
        const float size = 1 + max_component(eval_bsdf(b, to_eye, to_light));
        EXPECT_LE(max_component(glm::abs(diffuse - expected)), 1e-6f * size);
    }
}

// Facets are reciprocal, through glass with the squared index on the eye's side.
TEST(Bsdf, FacetsAreReciprocal) {
    Rng rng(7);
    const auto any = [&] { return direction(2 * rng.uniform() - 1, 9 * rng.uniform()); };
    for (const float roughness : {0.1f, 0.4f, 1.0f})
        for (const Bsdf& b : {metal(roughness, {1, 0.5f, 0.2f}), pane(roughness, {1, 0.5f, 0.2f}),
                              solid(roughness, 1.5f), solid(roughness, 1 / 1.33f)})
            for (int i = 0; i < 500; ++i) {
                const Vec3 v = any(), w = any();
                const bool bends = !b.thin && v.z * w.z < 0;
                const float index = !bends ? 1.0f : (v.z > 0 ? b.eta * b.eta : 1 / (b.eta * b.eta));
                const Rgb there = eval_bsdf(b, v, w) * index;
                const Rgb back = eval_bsdf(b, w, v);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(there[c], back[c], 1e-3f * (back[c] + 1e-3f)) << b.eta << " " << i;
            }
}

// A pane reflects 2R / (1 + R), R = ((n - 1) / (n + 1))^2 = 0.04, and a shadow ray keeps the rest.
TEST(Bsdf, APaneReflectsAtBothFaces) {
    const Bsdf b = pane(0);
    EXPECT_TRUE(is_delta_only(b));
    EXPECT_NEAR(straight_transmittance(b, 1).g, 1 - 0.08f / 1.04f, 1e-6f);
    EXPECT_NEAR(straight_transmittance(b, -1).g, 1 - 0.08f / 1.04f, 1e-6f);
    EXPECT_EQ(straight_transmittance(b, 0), Rgb(0));
    EXPECT_EQ(straight_transmittance(pane(0.5f), 1), Rgb(0));
    EXPECT_EQ(straight_transmittance(solid(0, 1.5f), 1), Rgb(0));
    // With half lost on each way across: the series (1-R)^2 t (1 + R^2 t^2 + ...).
    EXPECT_NEAR(straight_transmittance(pane(0, Rgb(0.5f)), 1).g,
                0.96f * 0.96f * 0.5f / (1 - 0.04f * 0.04f * 0.25f), 1e-6f);

    const Vec3 eye = direction(0.6f, 1);
    const auto through = sample_bsdf(b, eye, 0.999f, {0.5f, 0.5f});
    ASSERT_TRUE(through && through->delta() && through->lobe == Lobe::transmission);
    EXPECT_NEAR(glm::distance(through->direction, -eye), 0, 1e-6f);
}

// Snell's law; radiance is compressed by the square of the index, importance is not.
TEST(Bsdf, ASmoothSolidRefracts) {
    const Bsdf b = solid(0, 1.5f);
    const Vec3 eye = direction(0.5f);
    const auto seen = sample_bsdf(b, eye, 0.999f, {0, 0});
    const auto carried = sample_bsdf(b, eye, 0.999f, {0, 0}, Transport::importance);
    ASSERT_TRUE(seen && carried && seen->lobe == Lobe::transmission);
    EXPECT_NEAR(seen->direction.x, -eye.x / 1.5f, 1e-6f);
    EXPECT_NEAR(glm::length(seen->direction), 1, 1e-6f);
    EXPECT_NEAR(seen->weight.r * 1.5f * 1.5f, carried->weight.r, 1e-5f);
    EXPECT_NEAR(carried->weight.r, 1, 1e-5f);
    // Past the critical angle, of cosine sqrt(1 - 1/n^2) = 0.745, all is reflected.
    const auto inside = sample_bsdf(solid(0, 1 / 1.5f), direction(0.74f), 0.9999f, {0, 0});
    ASSERT_TRUE(inside && inside->lobe == Lobe::reflection);
    EXPECT_EQ(inside->weight, Rgb(1));
}

TEST(Fresnel, NormalIncidenceCriticalAngleAndGrazing) {
    for (const float n : {1.33f, 1.5f, 2.4f}) {
        EXPECT_NEAR(fresnel_dielectric(1, n), (n - 1) * (n - 1) / ((n + 1) * (n + 1)), 1e-6f);
        EXPECT_NEAR(fresnel_dielectric(1, n), normal_reflectance(1 / n), 1e-6f);
        const float critical = std::sqrt(1 - 1 / (n * n));
        EXPECT_EQ(fresnel_dielectric(critical - 1e-4f, 1 / n), 1);
        EXPECT_LT(fresnel_dielectric(critical + 1e-3f, 1 / n), 1);
        EXPECT_EQ(fresnel_dielectric(0, n), 1);
        // At Brewster's angle, tan = n, light of one polarisation is not reflected at all.
        const float s = (n * n - 1) / (n * n + 1);
        EXPECT_NEAR(fresnel_dielectric(1 / std::sqrt(1 + n * n), n), 0.5f * s * s, 1e-6f);
    }
}

// A smooth coat is exactly what Schlick says, the base what that leaves over.
TEST(Bsdf, ASmoothCoatLeavesTheRestToTheBase) {
    const Bsdf b = plastic(0, Rgb(0.5f));
    const float coat = 0.04f + 0.96f * std::pow(0.3f, 5.0f);
    EXPECT_NEAR(diffuse_albedo(b, 0.7f).g, 0.5f * (1 - coat), 1e-6f);
    EXPECT_NEAR(furnace(b, 0.7f).g, coat + 0.5f * (1 - coat), 1e-4f);
    EXPECT_FALSE(is_delta_only(b));
    EXPECT_TRUE(is_delta_only(specular_only(b)));
}

// Between the tables' nodes, against the sum over all directions (its own error is below 0.0005).
TEST(Bsdf, TheTablesAreAsExactAsTheySay) {
    for (const float alpha : {0.19f, 0.44f, 0.87f})
        for (const float cosine : {0.06f, 0.41f, 0.97f}) {
            const Vec3 eye = direction(cosine);
            const Vec2 sum = integrate_sphere(360, [&](Vec3 w) {
                if (w.z <= 0) return Vec2(0);
                const Vec3 h = glm::normalize(eye + w);
                return ggx_density(h, alpha) * ggx_visibility(cosine, w.z, alpha) * w.z *
                       Vec2(1, schlick_weight(glm::dot(eye, h)));
            });
            const MirrorAlbedo albedo = mirror_albedo(alpha, cosine);
            EXPECT_NEAR(albedo.full, sum.x, 0.0045f) << alpha << " " << cosine;
            EXPECT_NEAR(albedo.schlick, sum.y, 0.0045f) << alpha << " " << cosine;
        }
}

}  // namespace
}  // namespace chiaro
