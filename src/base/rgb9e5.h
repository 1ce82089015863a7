// RGB9E5: three 9-bit mantissas and a shared 5-bit exponent in 32 bits (OpenGL 4.5, 8.25), the form
// in which shading values go to the display. Steps are 0.2 to 0.4 % of the largest channel.
#pragma once

#include "base/color.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace chiaro {

/// Channels are clamped to [0, 65408]; not-a-number becomes 0.
inline std::uint32_t pack_rgb9e5(Rgb c) {
    const auto limit = [](float x) { return x > 0.0f ? std::min(x, 65408.0f) : 0.0f; };
    const float r = limit(c.r), g = limit(c.g), b = limit(c.b);
    const float largest = std::max({r, g, b});
    // The exponent of `largest`, read from its bits; 2^-16 is the smallest that the format has.
    int exponent = static_cast<int>(std::bit_cast<std::uint32_t>(largest) >> 23) - 127;
    exponent = std::max(exponent, -16) + 1;
    const auto scale_for = [](int e) { return std::bit_cast<float>((127 + 9 - e) << 23); };
    float scale = scale_for(exponent);
    if (static_cast<int>(largest * scale + 0.5f) == 512) scale = scale_for(++exponent);
    const auto mantissa = [&](float x) { return static_cast<std::uint32_t>(x * scale + 0.5f); };
    return mantissa(r) | mantissa(g) << 9 | mantissa(b) << 18 |
           static_cast<std::uint32_t>(exponent + 15) << 27;
}

inline Rgb unpack_rgb9e5(std::uint32_t bits) {
    const int exponent = static_cast<int>(bits >> 27) - 15 - 9;
    const float scale = std::bit_cast<float>((127 + exponent) << 23);
    const auto channel = [&](int shift) {
        return static_cast<float>(bits >> shift & 0x1ff) * scale;
    };
    return {channel(0), channel(9), channel(18)};
}

}  // namespace chiaro
