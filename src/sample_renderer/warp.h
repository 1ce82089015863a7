// From the unit square to directions; each mapping stands beside its density.
#pragma once

#include "base/vec8.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>

namespace chiaro {

/// `a` if `first`, else `b`, without a branch: random numbers decide, and no processor foresees
/// them.
inline float select(bool first, float a, float b) {
    const std::uint32_t mask = 0U - static_cast<std::uint32_t>(first);
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

/// The unit disk, evenly, by the concentric map (Shirley and Chiu 1997): what is well spread over
/// the square stays so. For Vec2 and Vec2x8.
template <typename Pair>
Pair square_to_disk(const Pair& u) {
    using std::abs, std::copysign;
    using Number = std::remove_cvref_t<decltype(u.x)>;
    const Number x = Number(2) * u.x - Number(1);
    const Number y = Number(2) * u.y - Number(1);
    const auto by_x = abs(x) > abs(y);
    const Number radius = select(by_x, x, y);
    const Number other = select(by_x, y, x);

    // Sine and cosine up to pi / 4, where short series are exact to 4e-7. At the centre 0 / 1e-30.
    const Number angle =
        Number(kPi / 4) * other / copysign(larger(abs(radius), Number(1e-30f)), radius);
    const Number a2 = angle * angle;
    const auto series = [&](float first, auto... others) {
        Number sum(first);
        ((sum = sum * a2 + Number(others)), ...);
        return sum;
    };
    const Number sine = angle * series(-1 / 5040.0f, 1 / 120.0f, -1 / 6.0f, 1.0f);
    const Number cosine = series(1 / 40320.0f, -1 / 720.0f, 1 / 24.0f, -0.5f, 1.0f);
    return {radius * select(by_x, cosine, sine), radius * select(by_x, sine, cosine)};
}

/// Unit direction about +z with a density proportional to its cosine, which is above 0: on the rim
/// of the disk it is as much as floats can tell from it.
inline Vec3 square_to_cosine_hemisphere(Vec2 u) {
    const Vec2 d = square_to_disk(u);
    return {d.x, d.y, std::sqrt(std::max(1e-8f, 1 - glm::dot(d, d)))};
}
template <std::same_as<Vec2x8> Pair>  // no braces are taken for eight
Vec3x8 square_to_cosine_hemisphere(const Pair& u) {
    const Vec2x8 d = square_to_disk(u);
    return {d.x, d.y, sqrt(larger(Float8(1e-8f), Float8(1) - d.x * d.x - d.y * d.y))};
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
