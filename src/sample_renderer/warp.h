// From the unit square to directions; each mapping stands beside its density.
#pragma once

#include "base/vec.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace chiaro {

/// `a` if `first`, else `b`, without a branch: random numbers decide, and no processor foresees
/// them.
inline float select(bool first, float a, float b) {
    const std::uint32_t mask = 0U - static_cast<std::uint32_t>(first);
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

/// The unit disk, evenly, by the concentric map (Shirley and Chiu 1997): what is well spread over
/// the square stays so.
inline Vec2 square_to_disk(Vec2 u) {
    const float x = 2 * u.x - 1;
    const float y = 2 * u.y - 1;
    const bool by_x = std::abs(x) > std::abs(y);
    const float radius = select(by_x, x, y);
    const float other = select(by_x, y, x);

    // Sine and cosine up to pi / 4, where short series are exact to 4e-7. At the centre 0 / 1e-30.
    const float angle =
        (kPi / 4) * other / std::copysign(std::max(std::abs(radius), 1e-30f), radius);
    const float a2 = angle * angle;
    const float sine = angle * (1 + a2 * (-1 / 6.0f + a2 * (1 / 120.0f - a2 * (1 / 5040.0f))));
    const float cosine =
        1 + a2 * (-0.5f + a2 * (1 / 24.0f - a2 * (1 / 720.0f - a2 * (1 / 40320.0f))));
    return {radius * select(by_x, cosine, sine), radius * select(by_x, sine, cosine)};
}

/// Unit direction about +z with a density proportional to its cosine, which is above 0: on the rim
/// of the disk it is as much as floats can tell from it.
inline Vec3 square_to_cosine_hemisphere(Vec2 u) {
    const Vec2 d = square_to_disk(u);
    return {d.x, d.y, std::sqrt(std::max(1e-8f, 1 - glm::dot(d, d)))};
}
/// Density of the above over solid angle, from the direction's cosine [1 / steradian].
inline float pdf_cosine_hemisphere(float cosine) {
    return std::max(0.0f, cosine) * (1 / kPi);
}

/// Unit direction about +z, even over the cone whose rim has the cosine `cosine_of_rim`; -1: the
/// whole sphere.
inline Vec3 square_to_cone(Vec2 u, float cosine_of_rim) {
    const float z = 1 - u.x * (1 - cosine_of_rim);
    const float radius = std::sqrt(std::max(0.0f, 1 - z * z));
    const float azimuth = 2 * kPi * u.y;
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}
/// Density of the above over solid angle, inside of the cone [1 / steradian].
inline float pdf_cone(float cosine_of_rim) {
    return 1 / (2 * kPi * (1 - cosine_of_rim));
}

}  // namespace chiaro
