// How light is scattered at a point of a surface: the material there, resolved to one model.
//
// The model is that of glTF 2.0 (appendix B): GGX facets (Walter et al. 2007) over a diffuse base,
// a share of the surface transmitting instead. No light is lost between the facets
// (albedo_table.h): in white surroundings whatever absorbs nothing looks white.
//
// Directions are unit, point away from the surface and are in a frame whose +z is the shading
// normal on the side of the known direction: of the eye, or of `from`. z < 0 is beyond the surface.
#pragma once

#include "scene/surface.h"

#include <cstdint>
#include <optional>

namespace chiaro {

/// Facets of less roughness than this, and Phong lobes as narrow, are an even mirror: a Dirac delta
/// that only sample_bsdf() finds.
inline constexpr float kSmoothRoughness = 0.03f;

/// Facets of at least this width (Bsdf::alpha) reflect so little detail that a cache may keep what
/// they show; narrower ones ask for rays a pixel (docs/overview.md has the measurements).
inline constexpr float kCachedFacets = 0.25f * 0.25f;

struct Bsdf {
    Rgb diffuse = Rgb(0);  // albedo of the base, in [0, 1], times the part that is no metal
    float metal = 0;       // that part of what is no glass, [0, 1]: facets and no base
    Rgb f0 = Rgb(0);       // reflectance of the facets at normal incidence, in [0, f90]
    Rgb f90 = Rgb(0);      // and at grazing incidence, in [0, 1]; black: no facets
    float alpha = 0;       // width of the distribution of facets, [0.03^2, 1]; 0: smooth
    float glass = 0;       // share of the surface, [0, 1], that is glass and none of the above
    Rgb tint = Rgb(1);     // what glass lets through, in [0, 1], of light that it does not reflect
    float eta = 1.5f;      // index of the glass; of a solid, index beyond over index before
    bool thin = true;  // the glass is a pane: it does not bend light, and reflects at both faces

    bool smooth() const { return alpha == 0; }
};

/// The surface at `point`, met from its front or back.
Bsdf bsdf_at(const Scene& scene, const SurfacePoint& point, bool front);

inline bool has_facets(const Bsdf& b) {
    return b.glass < 1 && max_component(b.f90) > 0;
}
inline bool has_specular(const Bsdf& b) {
    return b.glass > 0 || has_facets(b);
}
inline bool has_diffuse(const Bsdf& b) {
    return b.glass < 1 && max_component(b.diffuse) > 0;
}

/// Nothing but `diffuse` over pi: callers need none of the functions below.
inline bool is_lambertian(const Bsdf& b) {
    return !has_specular(b);
}

/// eval_bsdf() is 0 everywhere: light samples are of no use here.
inline bool is_delta_only(const Bsdf& b) {
    return b.smooth() && !has_diffuse(b);
}

/// The surface without its diffuse light, for whoever has that from elsewhere.
inline Bsdf specular_only(Bsdf b) {
    b.diffuse = Rgb(0);
    return b;
}

/// The surface as it is met from its other side.
Bsdf turned(Bsdf bsdf);

/// What multiplies irradiance / pi: the base's albedo times what the facets leave over. It depends
/// on the cosine to the eye alone, so that a cached irradiance gives the diffuse radiance exactly;
/// in exchange it is not reciprocal.
Rgb diffuse_albedo(const Bsdf& bsdf, float cosine_to_eye);

/// Part of light from white surroundings that reaches the eye, about; in [0, 1] (for roulette).
Rgb total_albedo(const Bsdf& bsdf, float cosine_to_eye);

/// What goes straight on through a smooth pane, at the cosine of either side; 0 through all else.
/// What a shadow ray keeps.
Rgb straight_transmittance(const Bsdf& bsdf, float cosine);

/// True if straight_transmittance() of the material is above 0 somewhere, or may be.
bool may_pass_straight(const Material& material);

/// The largest Bsdf::alpha that a surface of the material may have; 0 if nothing of it is glossy.
float widest_facets(const Material& material);

/// Radiance toward the eye over irradiance by light from `to_light` [1 / steradian]: without the
/// cosine, without what is smooth. The roles are the light's, whoever walks: not even a path from a
/// lamp may exchange them, since neither the diffuse light is reciprocal nor refraction, which
/// multiplies radiance by the ratio of the squared indices. The eye may be below too: the surface
/// is then the same, seen from its other side.
Rgb eval_bsdf(const Bsdf& bsdf, Vec3 to_eye, Vec3 to_light);

/// What is carried along a walk: radiance from eyes toward lights, or importance the other way.
enum class Transport : std::uint8_t { radiance, importance };

enum class Lobe : std::uint8_t { diffuse, reflection, transmission };

struct BsdfSample {
    Vec3 direction;
    Rgb weight;  // value x |cosine of the direction| / density
    float pdf;   // as pdf_bsdf() has it [1 / steradian]; 0: a delta, to which `weight` is all
    Lobe lobe;

    bool delta() const { return pdf == 0; }
};

/// Continues a walk that came along `from`: to the eye where radiance is carried, to the light
/// where importance is. `u_lobe` in [0, 1), `u` in [0, 1)^2. None: the walk ends, at a facet that
/// leads into the surface, on a black one, or where `from` is not above.
std::optional<BsdfSample> sample_bsdf(const Bsdf& bsdf, Vec3 from, float u_lobe, Vec2 u,
                                      Transport transport = Transport::radiance);

/// Density over solid angle of sample_bsdf()'s directions, deltas and ends left out: it integrates
/// to less than 1. The same for both transports.
float pdf_bsdf(const Bsdf& bsdf, Vec3 from, Vec3 to);

/// What sample_bsdf() does at a smooth surface, by every branch and without chance: weights of the
/// mirrored direction and of the one through the surface, for radiance. Black where it is rough.
struct SmoothSplit {
    Rgb reflected = Rgb(0);
    Rgb transmitted = Rgb(0);
    Vec3 transmitted_from = Vec3(0, 0, -1);
};
SmoothSplit split_smooth(const Bsdf& bsdf, Vec3 from);

}  // namespace chiaro
