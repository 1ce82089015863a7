// How much light an even boundary reflects.
#pragma once

#include "base/color.h"

#include <algorithm>

namespace chiaro {

/// Reflectance of a clear boundary for unpolarised light (Fresnel), in [0, 1]. `cosine`, in [0, 1],
/// is that of the angle of incidence; `eta` the index beyond the boundary over the one before it.
/// 1 where the light is totally reflected.
inline float fresnel_dielectric(float cosine, float eta) {
    const float sine2_beyond = (1 - cosine * cosine) / (eta * eta);
    if (!(sine2_beyond < 1)) return 1;
    const float beyond = std::sqrt(1 - sine2_beyond);
    const float s = (cosine - eta * beyond) / (cosine + eta * beyond);
    const float p = (eta * cosine - beyond) / (eta * cosine + beyond);
    return 0.5f * (s * s + p * p);
}

/// Reflectance of a clear boundary at normal incidence, ((n - 1) / (n + 1))^2; `eta` >= 0.
inline float normal_reflectance(float eta) {
    const float root = (eta - 1) / (eta + 1);
    return root * root;
}

/// Weight of the grazing reflectance against the normal one, in [0, 1] (Schlick 1994).
inline float schlick_weight(float cosine) {
    const float x = std::clamp(1 - cosine, 0.0f, 1.0f);
    const float x2 = x * x;
    return x2 * x2 * x;
}

/// What becomes of light at a clear boundary or pane, as parts of it.
struct LightSplit {
    Rgb reflected;
    Rgb transmitted;  // in power: the compression of a solid angle by refraction is not in it
};

/// A pane whose two faces each reflect `r` and whose body lets `tint` through, in [0, 1]: the sum
/// over all reflections between the faces. Of a clear one 2 r / (1 + r) is reflected.
inline LightSplit split_at_pane(float r, Rgb tint) {
    const Rgb across = (1 - r) * tint / (1.0f - r * r * tint * tint + 1e-20f);
    return {r + (1 - r) * r * tint * across, (1 - r) * across};
}

}  // namespace chiaro
