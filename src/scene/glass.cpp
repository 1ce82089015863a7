#include "scene/glass.h"

#include "scene/albedo_table.h"
#include "scene/fresnel.h"
#include "scene/ggx.h"

namespace chiaro {
namespace {

LightSplit split_at_facet(const Bsdf& b, float cosine) {
    const float reflectance = fresnel_dielectric(cosine, b.eta);
    if (b.thin) return split_at_pane(reflectance, b.tint);
    return {Rgb(reflectance), (1 - reflectance) * b.tint};
}

// Of the walk's going on by reflection at a facet.
float chance_of_reflection(const LightSplit& split) {
    const float reflected = max_component(split.reflected);
    return reflected / (reflected + max_component(split.transmitted));
}

// The light that a single facet does not give back, as a part of all: where it leaves at `cosine`
// (below 0: beyond the surface), in the mean over the hemisphere before the surface, and over both,
// each weighted by the square of its index.
struct Missing {
    float at, before, both;

    // Part of the broad lobe that stays before the surface.
    float chance_of_reflection() const { return before / both; }
};

Missing missing_light(const Bsdf& b, float cosine) {
    constexpr float kLeast = 1e-9f;  // where the facets are nearly even
    if (b.thin) {
        const MirrorAlbedo albedo = mirror_albedo(b.alpha, std::abs(cosine));
        const float mean = std::max(1 - albedo.mean, kLeast);
        return {1 - albedo.full, mean, 2 * mean};
    }
    const bool beyond = cosine < 0;
    const GlassAlbedo albedo = glass_albedo(b.alpha, beyond ? 1 / b.eta : b.eta, std::abs(cosine));
    const float here = std::max(1 - albedo.mean, kLeast);
    const float there = std::max(1 - albedo.mean_beyond, kLeast);
    const float before = beyond ? there : here;
    return {1 - albedo.full, before, before + b.eta * b.eta * (beyond ? here : there)};
}

// The facet, on the side before the surface, that takes `w` to `beyond` by refraction.
Vec3 refracting_normal(Vec3 w, Vec3 beyond, float eta) {
    const Vec3 h = w + eta * beyond;
    return h * ((h.z < 0 ? -1.0f : 1.0f) / std::sqrt(std::max(glm::dot(h, h), 1e-20f)));
}

}  // namespace

Rgb eval_glass(const Bsdf& b, Vec3 to_eye, Vec3 to_light) {
    const bool reflects = to_light.z > 0;
    const float cosine = std::abs(to_light.z);

    // After several facets: the two sides share what is missing so that both get back all, and the
    // exchange is reciprocal.
    const Missing eye = missing_light(b, to_eye.z);
    const float several = eye.at * missing_light(b, to_light.z).at / (kPi * eye.both);
    const Rgb broad = reflects ? Rgb(several) : several * b.tint;

    // After one. A rough pane transmits as it reflects, to the other side.
    if (reflects || b.thin) {
        const Vec3 light = reflects ? to_light : across(to_light);
        const Vec3 h = glm::normalize(to_eye + light);
        const LightSplit split = split_at_facet(b, glm::dot(to_eye, h));
        return broad + ggx_density(h, b.alpha) * ggx_visibility(to_eye.z, cosine, b.alpha) *
                           (reflects ? split.reflected : split.transmitted);
    }
    const Vec3 h = refracting_normal(to_eye, to_light, b.eta);
    const float eye_h = glm::dot(to_eye, h);
    const float light_h = glm::dot(to_light, h);
    if (!(eye_h > 0 && light_h < 0)) return broad;
    // Walter et al. 2007, equation 21, the masking over the cosines.
    const float root = eye_h + b.eta * light_h;
    const float masking = 4 / (ggx_reach(to_eye.z, b.alpha) * ggx_reach(cosine, b.alpha));
    return broad + split_at_facet(b, eye_h).transmitted * masking * ggx_density(h, b.alpha) *
                       (eye_h * -light_h / std::max(root * root, 1e-12f));
}

float pdf_glass(const Bsdf& b, Vec3 from, Vec3 to) {
    const bool reflects = to.z > 0;
    const Missing missing = missing_light(b, from.z);
    const float broad_reflects = missing.chance_of_reflection();
    const float broad =
        missing.at * (reflects ? broad_reflects : 1 - broad_reflects) * std::abs(to.z) / kPi;
    if (reflects || b.thin) {
        const Vec3 h = glm::normalize(from + (reflects ? to : across(to)));
        const float cosine = glm::dot(from, h);
        const float chance = chance_of_reflection(split_at_facet(b, cosine));
        return broad + (1 - missing.at) * (reflects ? chance : 1 - chance) *
                           pdf_visible_normal(from, h, b.alpha) / std::max(4 * cosine, 1e-12f);
    }
    const Vec3 h = refracting_normal(from, to, b.eta);
    const float from_h = glm::dot(from, h);
    const float to_h = glm::dot(to, h);
    if (!(from_h > 0 && to_h < 0)) return broad;
    const float root = from_h + b.eta * to_h;
    const float facets_a_direction = b.eta * b.eta * -to_h / std::max(root * root, 1e-12f);
    return broad + (1 - missing.at) * (1 - chance_of_reflection(split_at_facet(b, from_h))) *
                       pdf_visible_normal(from, h, b.alpha) * facets_a_direction;
}

std::optional<GlassDirection> sample_glass(const Bsdf& b, Vec3 from, float u_lobe, Vec2 u,
                                           Transport transport) {
    Vec3 facet(0, 0, 1);
    if (!b.smooth()) {
        const Missing missing = missing_light(b, from.z);
        if (u_lobe < missing.at) {
            const Vec3 up = cosine_direction(u);
            const bool reflects = u_lobe < missing.at * missing.chance_of_reflection();
            return GlassDirection{reflects ? up : across(up), Rgb(0)};
        }
        u_lobe = std::min((u_lobe - missing.at) / (1 - missing.at), 0x1.fffffep-1f);
        facet = sample_visible_normal(from, b.alpha, u);
    }
    const LightSplit split = split_at_facet(b, glm::dot(from, facet));
    const float chance = chance_of_reflection(split);
    const Vec3 mirrored = reflected(from, facet);
    if (u_lobe < chance) {
        if (!(mirrored.z > 0)) return std::nullopt;
        return GlassDirection{mirrored, split.reflected / chance};
    }
    const Vec3 direction = b.thin ? across(mirrored) : refracted(from, facet, b.eta);
    if (!(direction.z < 0)) return std::nullopt;
    const bool compressed = !b.thin && transport == Transport::radiance;
    return GlassDirection{direction,
                          split.transmitted / ((1 - chance) * (compressed ? b.eta * b.eta : 1.0f))};
}

void add_smooth_glass(const Bsdf& b, Vec3 from, SmoothSplit& split) {
    const LightSplit parts = split_at_facet(b, from.z);
    split.reflected += b.glass * parts.reflected;
    split.transmitted = b.glass * parts.transmitted;
    if (b.thin) {
        split.transmitted_from = -from;
    } else if (max_component(parts.transmitted) > 0) {
        split.transmitted_from = refracted(from, Vec3(0, 0, 1), b.eta);
        split.transmitted /= b.eta * b.eta;
    }
}

Rgb glass_total_albedo(const Bsdf& b, float cosine) {
    const LightSplit split = split_at_facet(b, cosine);
    return split.reflected + split.transmitted;
}

Vec3 cosine_direction(Vec2 u) {
    const float azimuth = 2 * kPi * u.x;
    const float radius = std::sqrt(u.y);
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1 - u.y)};
}

}  // namespace chiaro
