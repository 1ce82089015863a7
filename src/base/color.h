// Linear Rec. 709 RGB in photometric units (docs/units.md).
#pragma once

#include "base/vec.h"

#include <cmath>

namespace chiaro {

/// Linear RGB, Rec. 709 primaries. Radiance [cd/m2 a channel], irradiance [lux a channel] or a
/// reflectance in [0, 1], as the name that holds it says.
using Rgb = Vec3;

/// Y of linear Rec. 709: the one number in lux or cd/m2.
inline float luminance(Rgb c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

inline float max_component(Rgb c) {
    return c.r > c.g ? (c.r > c.b ? c.r : c.b) : (c.g > c.b ? c.g : c.b);
}

/// sRGB transfer function (IEC 61966-2-1), [0, 1] to [0, 1].
inline float srgb_to_linear(float s) {
    return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}
inline float linear_to_srgb(float l) {
    return l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1.0f / 2.4f) - 0.055f;
}

}  // namespace chiaro
