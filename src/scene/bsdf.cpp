#include "scene/bsdf.h"

#include "scene/albedo_table.h"
#include "scene/fresnel.h"
#include "scene/ggx.h"
#include "scene/glass.h"

namespace chiaro {
namespace {

Rgb facet_reflectance(const Bsdf& b, float cosine) {
    return b.f0 + (b.f90 - b.f0) * schlick_weight(cosine);
}

// Part that comes out again of the light that one facet does not give back, `mean` as in
// MirrorAlbedo: the sum over all further facets (Kulla and Conty 2017). All of it where facets
// reflect all.
Rgb repeated_reflectance(const Bsdf& b, float mean) {
    const Rgb average = b.f0 + (b.f90 - b.f0) * (1 / 21.0f);  // schlick_weight() over a hemisphere
    return average * average * mean / (1.0f - average * (1 - mean) + 1e-9f);
}

// What the facets over the base give back of light from white surroundings.
struct FacetLight {
    Rgb once;                        // after one of them
    Rgb repeated;                    // after several: the broad lobe
    Rgb absorbed_by_metal = Rgb(0);  // of what falls on metal, where some of the surface is

    Rgb total() const { return once + repeated; }
};

FacetLight facet_light(const Bsdf& b, const MirrorAlbedo& albedo) {
    FacetLight light = {b.f0 * albedo.full + (b.f90 - b.f0) * albedo.schlick,
                        repeated_reflectance(b, albedo.mean) * (1 - albedo.full)};
    if (b.metal > 0 && has_diffuse(b)) {
        const Bsdf metal = {.f0 = b.diffuse / (1 - b.metal), .f90 = Rgb(1)};
        light.absorbed_by_metal = 1.0f - facet_light(metal, albedo).total();
    }
    return light;
}

FacetLight facet_light(const Bsdf& b, float cosine) {
    if (!has_facets(b)) return {Rgb(0), Rgb(0)};
    if (b.smooth()) return facet_light(b, {1, schlick_weight(cosine), 1});
    return facet_light(b, mirror_albedo(b.alpha, cosine));
}

// The base gets what the facets over it leave: of what they do not give back of all light, all but
// what the metal beside it absorbs.
Rgb base_albedo(const Bsdf& b, const FacetLight& facets) {
    const Rgb left = 1.0f - facets.total() - b.metal * facets.absorbed_by_metal;
    const Rgb color = b.metal < 1 ? b.diffuse / (1 - b.metal) : Rgb(0);
    return color * glm::max(left, Rgb(0));
}

// All but glass; both directions have z > 0.
Rgb eval_opaque(const Bsdf& b, Vec3 to_eye, Vec3 to_light) {
    if (!has_facets(b) || b.smooth()) return base_albedo(b, facet_light(b, to_eye.z)) * (1 / kPi);

    const MirrorAlbedo eye = mirror_albedo(b.alpha, to_eye.z);
    const MirrorAlbedo light = mirror_albedo(b.alpha, to_light.z);
    const FacetLight facets = facet_light(b, eye);
    const Rgb broad = base_albedo(b, facets) +
                      facets.repeated * ((1 - light.full) / std::max(1 - eye.mean, 1e-9f));
    const Vec3 h = glm::normalize(to_eye + to_light);
    const float once = ggx_density(h, b.alpha) * ggx_visibility(to_eye.z, to_light.z, b.alpha);
    return broad * (1 / kPi) + facet_reflectance(b, glm::dot(to_eye, h)) * once;
}

// With which probabilities a walk goes on by each kind of lobe: in proportion to what they give.
struct LobeChances {
    float broad = 0;   // cosine-distributed: the base, and light that met several facets
    float facets = 0;  // by one facet
    float glass = 0;
};

LobeChances lobe_chances(const Bsdf& b, float cosine) {
    if (b.glass >= 1) return {0, 0, 1};
    if (!has_facets(b) && b.glass == 0) return {1, 0, 0};
    const FacetLight light = facet_light(b, cosine);
    const float opaque = 1 - b.glass;
    const float broad = opaque * max_component(base_albedo(b, light) + light.repeated);
    const float facets = opaque * max_component(light.once);
    const float sum = broad + facets + b.glass;
    if (!(sum > 0)) return {};
    return {broad / sum, facets / sum, b.glass / sum};
}

// Of all lobes that are no deltas; from.z > 0.
float density(const Bsdf& b, const LobeChances& chances, Vec3 from, Vec3 to) {
    float sum = 0;
    if (to.z > 0) {
        sum += chances.broad * to.z * (1 / kPi);
        if (chances.facets > 0 && !b.smooth()) {
            const Vec3 h = glm::normalize(from + to);
            sum += chances.facets * pdf_visible_normal(from, h, b.alpha) /
                   std::max(4 * glm::dot(from, h), 1e-12f);
        }
    }
    if (chances.glass > 0 && !b.smooth()) sum += chances.glass * pdf_glass(b, from, to);
    return sum;
}

}  // namespace

Bsdf turned(Bsdf b) {
    if (!b.thin) b.eta = 1 / b.eta;
    return b;
}

Rgb diffuse_albedo(const Bsdf& b, float cosine_to_eye) {
    if (is_lambertian(b)) return b.diffuse;
    return (1 - b.glass) * base_albedo(b, facet_light(b, cosine_to_eye));
}

Rgb total_albedo(const Bsdf& b, float cosine_to_eye) {
    const FacetLight facets = facet_light(b, cosine_to_eye);
    const Rgb opaque = base_albedo(b, facets) + facets.total();
    if (b.glass == 0) return opaque;
    return (1 - b.glass) * opaque + b.glass * glass_total_albedo(b, cosine_to_eye);
}

Rgb straight_transmittance(const Bsdf& b, float cosine) {
    if (b.glass == 0 || !b.thin || !b.smooth()) return Rgb(0);
    const float reflectance = fresnel_dielectric(std::min(std::abs(cosine), 1.0f), b.eta);
    return b.glass * split_at_pane(reflectance, b.tint).transmitted;
}

Rgb eval_bsdf(const Bsdf& b, Vec3 to_eye, Vec3 to_light) {
    if (to_eye.z < 0) return eval_bsdf(turned(b), across(to_eye), across(to_light));
    if (to_eye.z == 0 || to_light.z == 0) return Rgb(0);
    Rgb value(0);
    if (b.glass < 1 && to_light.z > 0) value += (1 - b.glass) * eval_opaque(b, to_eye, to_light);
    if (b.glass > 0 && !b.smooth()) value += b.glass * eval_glass(b, to_eye, to_light);
    return value;
}

float pdf_bsdf(const Bsdf& b, Vec3 from, Vec3 to) {
    if (!(from.z > 0) || to.z == 0) return 0;
    return density(b, lobe_chances(b, from.z), from, to);
}

std::optional<BsdfSample> sample_bsdf(const Bsdf& b, Vec3 from, float u_lobe, Vec2 u,
                                      Transport transport) {
    if (!(from.z > 0)) return std::nullopt;
    const LobeChances chances = lobe_chances(b, from.z);
    BsdfSample sample = {};

    if (u_lobe < chances.glass) {
        const auto glass = sample_glass(b, from, u_lobe / chances.glass, u, transport);
        if (!glass) return std::nullopt;
        sample.direction = glass->direction;
        sample.lobe = glass->direction.z > 0 ? Lobe::reflection : Lobe::transmission;
        sample.weight = glass->weight * (b.glass / chances.glass);
        if (b.smooth()) return sample;
    } else if (u_lobe < chances.glass + chances.facets) {
        sample.lobe = Lobe::reflection;
        if (b.smooth()) {
            sample.direction = reflected(from, Vec3(0, 0, 1));
            sample.weight = facet_reflectance(b, from.z) * ((1 - b.glass) / chances.facets);
            return sample;
        }
        sample.direction = reflected(from, sample_visible_normal(from, b.alpha, u));
        if (!(sample.direction.z > 0)) return std::nullopt;
    } else {
        sample.lobe = Lobe::diffuse;
        sample.direction = cosine_direction(u);
    }

    // What is not a delta is weighed against all the lobes that could have led there.
    sample.pdf = density(b, chances, from, sample.direction);
    if (!(sample.pdf > 0)) return std::nullopt;
    const bool to_light = transport == Transport::radiance;
    const Rgb value =
        to_light ? eval_bsdf(b, from, sample.direction) : eval_bsdf(b, sample.direction, from);
    sample.weight = value * (std::abs(sample.direction.z) / sample.pdf);
    return sample;
}

SmoothSplit split_smooth(const Bsdf& b, Vec3 from) {
    SmoothSplit split;
    if (!b.smooth()) return split;
    if (has_facets(b)) split.reflected = (1 - b.glass) * facet_reflectance(b, from.z);
    if (b.glass > 0) add_smooth_glass(b, from, split);
    return split;
}

}  // namespace chiaro
