// From materials, as files have them, to surfaces.
#include "base/random.h"
#include "sample_renderer/tiny_scenes.h"
#include "scene/bsdf.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

Bsdf surface_of(const Gloss& gloss, Rgb color = {0.5f, 0.4f, 0.2f}, bool front = true) {
    Scene scene;
    const MaterialId material = tiny::add_material(scene, color);
    scene.materials[0].gloss = gloss;
    tiny::add_quad(scene, Vec3(0), {1, 0, 0}, {0, 1, 0}, material);
    return bsdf_at(scene, {ObjectId(0), 0, 0.25f, 0.5f}, front);
}

Gloss gltf(float metallic, float roughness) {
    Gloss gloss;
    gloss.model = GlossModel::metallic_roughness;
    gloss.metallic = metallic;
    gloss.roughness = roughness;
    return gloss;
}

Gloss mtl(int illumination_model, float specular, float shininess) {
    Gloss gloss;
    gloss.model = GlossModel::phong;
    gloss.specular = Rgb(specular);
    gloss.shininess = shininess;
    gloss.illumination_model = illumination_model;
    return gloss;
}

void expect_near(Rgb a, Rgb b) {
    EXPECT_LE(max_component(glm::abs(a - b)), 1e-6f) << a.r << " " << b.r;
}

// Lambert's law: base colour / pi in all directions, sampled by the cosine with the base colour as
// weight, which is what renderers of diffuse light do.
TEST(BsdfAt, WithoutGlossASurfaceIsLambertian) {
    const Rgb color(0.5f, 0.4f, 0.2f);
    Gloss without_specular = gltf(0, 1);
    without_specular.specular_factor = 0;
    for (const Gloss& gloss :
         {Gloss(), mtl(2, 0, 50), mtl(1, 1, 50), mtl(0, 1, 50), without_specular}) {
        const Bsdf b = surface_of(gloss, color);
        EXPECT_TRUE(is_lambertian(b));
        EXPECT_TRUE(has_diffuse(b));
        EXPECT_FALSE(is_delta_only(b));
        EXPECT_EQ(diffuse_albedo(b, 0.3f), color);
        EXPECT_EQ(total_albedo(b, 0.3f), color);
        Rng rng(2);
        for (int i = 0; i < 100; ++i) {
            const auto s =
                sample_bsdf(b, {0.6f, 0, 0.8f}, rng.uniform(), {rng.uniform(), rng.uniform()});
            ASSERT_TRUE(s);
            expect_near(s->weight, color);
            EXPECT_NEAR(s->pdf, s->direction.z / kPi, 1e-6f);
            expect_near(eval_bsdf(b, {0.6f, 0, 0.8f}, s->direction), color / kPi);
        }
        EXPECT_EQ(eval_bsdf(b, {0, 0, 1}, {0, 0, -1}), Rgb(0));
    }
}

// glTF 2.0: a dielectric of index 1.5 reflects 0.04 at normal incidence over a diffuse base, a
// metal its base colour over nothing; alpha is the roughness squared.
TEST(BsdfAt, GltfMetallicRoughness) {
    const Rgb color(0.5f, 0.4f, 0.2f);
    const Bsdf plastic = surface_of(gltf(0, 0.5f));
    expect_near(plastic.diffuse, color);
    expect_near(plastic.f0, Rgb(0.04f));
    expect_near(plastic.f90, Rgb(1));
    EXPECT_FLOAT_EQ(plastic.alpha, 0.25f);
    EXPECT_EQ(plastic.glass, 0);

    const Bsdf metal = surface_of(gltf(1, 0.02f));
    expect_near(metal.f0, color);
    EXPECT_FALSE(has_diffuse(metal));
    EXPECT_TRUE(metal.smooth());
    EXPECT_TRUE(is_delta_only(metal));

    const Bsdf half = surface_of(gltf(0.5f, 1));
    expect_near(half.diffuse, 0.5f * color);
    expect_near(half.f0, 0.5f * (Rgb(0.04f) + color));
}

// KHR_materials_ior and _specular: f0 = min(((n-1)/(n+1))^2 colour, 1) x factor, f90 = factor.
TEST(BsdfAt, GltfIndexAndSpecular) {
    Gloss gloss = gltf(0, 0.5f);
    gloss.ior = 2;
    gloss.specular_factor = 0.5f;
    gloss.specular_color = {1, 0.5f, 30};
    const Bsdf b = surface_of(gloss);
    expect_near(b.f0, Rgb(0.5f / 9, 0.25f / 9, 0.5f));
    expect_near(b.f90, Rgb(0.5f));
    gloss.ior = 0;  // facets that reflect all
    expect_near(surface_of(gloss).f0, Rgb(0.5f, 0.25f, 0.5f));
}

// The metallic-roughness texture: blue times the metallic factor, green times the roughness.
TEST(BsdfAt, GltfTextureOfMetallicAndRoughness) {
    Scene scene;
    const MaterialId material = tiny::add_material(scene, Rgb(1));
    Texture texture;
    texture.width = texture.height = 1;
    texture.srgb = false;
    texture.texels = {{0, 102, 51, 255}};  // roughness 0.4, metallic 0.2
    scene.textures.push_back(texture);
    scene.materials[0].gloss = gltf(0.5f, 0.5f);
    scene.materials[0].gloss.metallic_roughness.texture = TextureId(0);
    tiny::add_quad(scene, Vec3(0), {1, 0, 0}, {0, 1, 0}, material);
    const Bsdf b = bsdf_at(scene, {ObjectId(0), 0, 0.25f, 0.5f}, true);
    EXPECT_NEAR(b.alpha, 0.04f, 1e-6f);
    expect_near(b.diffuse, Rgb(0.9f));
}

// KHR_materials_transmission: a pane of the base colour, of what is not metal; a solid is met at
// n from its front and at 1 / n from its back.
TEST(BsdfAt, GltfTransmission) {
    const Rgb color(0.5f, 0.4f, 0.2f);
    Gloss gloss = gltf(0, 0);
    gloss.transmission = 1;
    const Bsdf pane = surface_of(gloss, color, false);
    EXPECT_EQ(pane.glass, 1);
    EXPECT_TRUE(pane.thin);
    EXPECT_EQ(pane.eta, 1.5f);
    EXPECT_TRUE(is_delta_only(pane));
    expect_near(pane.tint, color);
    gloss.thin = false;
    EXPECT_EQ(surface_of(gloss, color, true).eta, 1.5f);
    EXPECT_EQ(surface_of(gloss, color, false).eta, 1 / 1.5f);

    gloss.metallic = 0.5f;
    gloss.transmission = 0.5f;
    const Bsdf part = surface_of(gloss);
    EXPECT_EQ(part.glass, 0.25f);  // and of the other 3/4 two thirds are metal
    expect_near(part.diffuse, color / 3.0f);
}

// MTL: Ks is the reflectance at every angle, Ns the exponent of a lobe as wide as alpha =
// sqrt(2 / (Ns + 2)).
TEST(BsdfAt, MtlGloss) {
    const Bsdf b = surface_of(mtl(2, 0.3f, 48));
    expect_near(b.f0, Rgb(0.3f));
    expect_near(b.f90, Rgb(0.3f));
    EXPECT_FLOAT_EQ(b.alpha, 0.2f);
    expect_near(b.diffuse, Rgb(0.5f, 0.4f, 0.2f));
    EXPECT_FALSE(surface_of(mtl(2, 0.3f, 1000)).smooth());
}

// illum 3 reflects sharply and alike at all angles, 5 more at grazing ones.
TEST(BsdfAt, MtlMirrors) {
    for (const float shininess : {0.0f, 100.0f, 1000.0f}) {
        const Bsdf mirror = surface_of(mtl(3, 0.9f, shininess), Rgb(0));
        EXPECT_TRUE(is_delta_only(mirror));
        const auto s = sample_bsdf(mirror, {0.6f, 0, 0.8f}, 0.5f, {0.5f, 0.5f});
        ASSERT_TRUE(s && s->delta());
        expect_near(s->direction, {-0.6f, 0, 0.8f});
        expect_near(s->weight, Rgb(0.9f));
        expect_near(surface_of(mtl(5, 0.9f, shininess)).f90, Rgb(1));
    }
    EXPECT_FALSE(surface_of(mtl(3, 0.9f, 50)).smooth());
}

// Tf filters what passes an object: once through a pane, half (its root) at each face of a solid.
TEST(BsdfAt, MtlGlass) {
    Gloss gloss = mtl(7, 0.3f, 200);
    gloss.transmission = 1;
    gloss.transmission_color = {0.25f, 1, 0};
    gloss.ior = 1.33f;
    const Bsdf pane = surface_of(gloss);
    EXPECT_TRUE(is_delta_only(pane));
    expect_near(pane.tint, {0.25f, 1, 0});
    gloss.thin = false;
    gloss.shininess = 48;
    const Bsdf solid = surface_of(gloss);
    expect_near(solid.tint, {0.5f, 1, 0});
    EXPECT_FLOAT_EQ(solid.eta, 1.33f);
    EXPECT_FLOAT_EQ(solid.alpha, 0.2f);
}

// Numbers that no surface has are brought to those of one.
TEST(BsdfAt, ParametersOutOfRange) {
    for (const float odd : {-1e30f, -1.0f, 0.0f, 1e-30f, 0.5f, 7.0f, 1e30f})
        for (Gloss gloss : {gltf(odd, odd), mtl(2, odd, odd), mtl(7, odd, odd)}) {
            gloss.ior = std::abs(odd);
            gloss.specular_factor = gloss.transmission = odd;
            gloss.specular_color = gloss.transmission_color = Rgb(odd);
            gloss.thin = false;
            const Bsdf b = surface_of(gloss);
            for (const float x : {b.f0.r, b.f90.r, b.alpha, b.glass, b.tint.r, b.diffuse.r}) {
                EXPECT_TRUE(x >= 0 && x <= 1) << odd;
            }
            EXPECT_TRUE(b.eta >= 1 && b.eta <= 3) << odd;
        }
}

}  // namespace
}  // namespace chiaro
