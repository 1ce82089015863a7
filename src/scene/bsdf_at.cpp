// From the parameters that files have to those of the model.

#include "scene/bsdf.h"
#include "scene/fresnel.h"

namespace chiaro {
namespace {

constexpr float kSmoothAlpha = kSmoothRoughness * kSmoothRoughness;

// From here on a file that asks for traced reflections (illum 3 to 7) wants them sharp: the
// exponent is for the highlights of lamps.
constexpr float kSharpShininess = 100;

// Indices of refraction that glass is computed for. Clear bodies of a lower one hardly bend light.
constexpr float kLeastIndex = 1.01f;
constexpr float kLargestIndex = 3;

float alpha_or_smooth(float alpha) {
    return alpha < kSmoothAlpha ? 0.0f : std::min(alpha, 1.0f);
}

// Width of the facets' distribution whose highlight is about that of Phong's cosine to the power
// `shininess` (Walter et al. 2007).
float phong_alpha(float shininess) {
    return std::sqrt(2 / (std::max(shininess, 0.0f) + 2));
}

void set_glass(const Gloss& gloss, float share, Rgb tint, bool front, Bsdf& b) {
    if (!(share > 0)) return;
    const float index = std::clamp(gloss.ior, kLeastIndex, kLargestIndex);
    b.glass = std::min(share, 1.0f);
    b.tint = glm::clamp(tint, 0.0f, 1.0f);
    b.thin = gloss.thin;
    b.eta = gloss.thin || front ? index : 1 / index;
}

// glTF 2.0, appendix B, with KHR_materials_ior, _specular and _transmission. The glass takes its
// reflectance from the index alone.
Bsdf from_metallic_roughness(const Gloss& gloss, Rgb color, Vec2 factors, bool front) {
    const float metallic = std::clamp(factors.x, 0.0f, 1.0f);
    const float roughness = std::clamp(factors.y, 0.0f, 1.0f);
    Bsdf b;
    b.alpha = alpha_or_smooth(roughness * roughness);

    // An index of 0 stands for facets that reflect all (KHR_materials_ior); nothing passes these.
    const float transmission = gloss.ior < 1 ? 0.0f : std::clamp(gloss.transmission, 0.0f, 1.0f);
    set_glass(gloss, (1 - metallic) * transmission, color * gloss.transmission_color, front, b);
    if (b.glass == 1) return b;

    // The rest: metal, and a base under clear facets.
    const float metal = std::min(metallic / (1 - b.glass), 1.0f);
    const float factor = std::clamp(gloss.specular_factor, 0.0f, 1.0f);
    const Rgb clear =
        glm::clamp(normal_reflectance(gloss.ior) * gloss.specular_color, 0.0f, 1.0f) * factor;
    b.diffuse = (1 - metal) * color;
    b.metal = metal;
    b.f0 = glm::mix(clear, color, metal);
    b.f90 = Rgb(glm::mix(factor, 1.0f, metal));
    return b;
}

float phong_facets(const Gloss& gloss) {
    const bool traced = gloss.illumination_model >= 3 && gloss.illumination_model <= 7;
    const bool sharp = traced && (gloss.shininess == 0 || gloss.shininess >= kSharpShininess);
    return sharp ? 0.0f : alpha_or_smooth(phong_alpha(gloss.shininess));
}

bool shines(const Gloss& gloss) {
    return gloss.illumination_model >= 2 && max_component(gloss.specular) > 0;
}

// MTL. Only illum 5 has Fresnel's increase toward grazing angles; the others reflect Ks alike.
Bsdf from_phong(const Gloss& gloss, Rgb color, bool front) {
    Bsdf b;
    b.alpha = phong_facets(gloss);

    // Tf filters what passes through the object: half of it at each face of a solid.
    const Rgb filter = glm::clamp(gloss.transmission_color, 0.0f, 1.0f);
    set_glass(gloss, gloss.transmission, gloss.thin ? filter : glm::sqrt(filter), front, b);
    if (b.glass == 1) return b;

    b.diffuse = color;
    if (!shines(gloss)) return b;
    b.f0 = glm::clamp(gloss.specular, 0.0f, 1.0f);
    b.f90 = gloss.illumination_model == 5 ? Rgb(1) : b.f0;
    return b;
}

}  // namespace

bool may_pass_straight(const Material& material) {
    const Gloss& gloss = material.gloss;
    return gloss.model != GlossModel::none && gloss.thin && gloss.transmission > 0;
}

float widest_facets(const Material& material) {
    const Gloss& gloss = material.gloss;
    switch (gloss.model) {
        case GlossModel::none:
            break;
        case GlossModel::metallic_roughness:
            if (gloss.metallic > 0 || gloss.specular_factor > 0 || gloss.transmission > 0)
                return alpha_or_smooth(gloss.roughness * gloss.roughness);
            break;
        case GlossModel::phong:
            if (shines(gloss) || gloss.transmission > 0) return phong_facets(gloss);
            break;
    }
    return 0;
}

Bsdf bsdf_at(const Scene& scene, const SurfacePoint& point, bool front) {
    const Gloss& gloss = scene.material(material_of(scene, point)).gloss;
    const Rgb color(base_color(scene, point));
    switch (gloss.model) {
        case GlossModel::none:
            break;
        case GlossModel::metallic_roughness:
            return from_metallic_roughness(gloss, color, metallic_roughness(scene, point), front);
        case GlossModel::phong:
            return from_phong(gloss, color, front);
    }
    Bsdf b;
    b.diffuse = color;
    return b;
}

}  // namespace chiaro
