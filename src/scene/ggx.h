// Microfacets distributed as GGX, and the light that they mask (Walter et al. 2007; Heitz 2014).
// Directions are unit, in a frame whose +z is the normal of the surface; `alpha`, in (0, 1], is the
// width of the distribution.
#pragma once

#include "base/vec.h"

#include <algorithm>
#include <cmath>

namespace chiaro {

/// Density of facets of normal `h` per area of the surface [1 / steradian].
inline float ggx_density(Vec3 h, float alpha) {
    // By the tangent's parts and not 1 - z^2, which for a narrow lobe is all rounding error.
    const float a2 = alpha * alpha;
    const float spread = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
    return 1 / (kPi * a2 * spread * spread);
}

/// cos + sqrt(alpha^2 sin^2 + cos^2): all that masking needs of a direction; `cosine` in [0, 1].
inline float ggx_reach(float cosine, float alpha) {
    return cosine + std::sqrt(alpha * alpha * (1 - cosine * cosine) + cosine * cosine);
}

/// Part of the facets that a direction sees and that are not masked (Smith), in [0, 1].
inline float ggx_g1(float cosine, float alpha) {
    return 2 * cosine / ggx_reach(cosine, alpha);
}

/// Height-correlated masking and shadowing over 4 cos cos, for reflection; cosines in [0, 1].
inline float ggx_visibility(float cosine_a, float cosine_b, float alpha) {
    const float root_a = ggx_reach(cosine_a, alpha) - cosine_a;
    const float root_b = ggx_reach(cosine_b, alpha) - cosine_b;
    return 0.5f / std::max(cosine_a * root_b + cosine_b * root_a, 1e-12f);
}

/// Normal of a facet that `w` (z > 0) sees, with density pdf_visible_normal(); `u` in [0, 1)^2
/// (Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023).
inline Vec3 sample_visible_normal(Vec3 w, float alpha, Vec2 u) {
    const Vec3 stretched = glm::normalize(Vec3(alpha * w.x, alpha * w.y, w.z));
    const float azimuth = 2 * kPi * u.x;
    const float z = (1 - u.y) * (1 + stretched.z) - stretched.z;
    const float radius = std::sqrt(std::clamp(1 - z * z, 0.0f, 1.0f));
    const Vec3 h = Vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), z) + stretched;
    return glm::normalize(Vec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-6f)));
}
/// Density of the above over solid angle [1 / steradian]; 0 for normals that `w` does not see.
inline float pdf_visible_normal(Vec3 w, Vec3 h, float alpha) {
    const float cosine = glm::dot(w, h);
    if (!(cosine > 0)) return 0;
    return 2 * ggx_density(h, alpha) * cosine / ggx_reach(w.z, alpha);
}

/// Where light of a facet of normal `h` goes that comes along `w`, dot(w, h) > 0: mirrored, or
/// refracted where it is not totally reflected, `eta` the index beyond the facet over that before.
inline Vec3 reflected(Vec3 w, Vec3 h) {
    return 2 * glm::dot(w, h) * h - w;
}
inline Vec3 refracted(Vec3 w, Vec3 h, float eta) {
    const float cosine = glm::dot(w, h);
    const float beyond2 = 1 - (1 - cosine * cosine) / (eta * eta);
    return (cosine / eta - std::sqrt(std::max(beyond2, 0.0f))) * h - w / eta;
}

}  // namespace chiaro
