// Grids of cells, each of 2^3 of the next finer grid, in the order of a Morton curve: the code of a
// cell of any grid is a prefix of the codes within it.
#pragma once

#include "base/vec.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace chiaro {

using CellPlace = std::array<std::uint32_t, 3>;  // counted from the grid's corner, a number an axis

/// 21 bits an axis.
inline constexpr std::uint32_t kMostCells = 1U << 21;

namespace detail {

/// Moves bit i to bit 3 i; 21 bits.
inline std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | x << 32) & 0x001f'0000'0000'ffffULL;
    x = (x | x << 16) & 0x001f'0000'ff00'00ffULL;
    x = (x | x << 8) & 0x100f'00f0'0f00'f00fULL;
    x = (x | x << 4) & 0x10c3'0c30'c30c'30c3ULL;
    return (x | x << 2) & 0x1249'2492'4924'9249ULL;
}
/// The inverse; other bits than every third are left out.
inline std::uint32_t gather_bits(std::uint64_t x) {
    x &= 0x1249'2492'4924'9249ULL;
    x = (x | x >> 2) & 0x10c3'0c30'c30c'30c3ULL;
    x = (x | x >> 4) & 0x100f'00f0'0f00'f00fULL;
    x = (x | x >> 8) & 0x001f'0000'ff00'00ffULL;
    x = (x | x >> 16) & 0x001f'0000'0000'ffffULL;
    return static_cast<std::uint32_t>(x | x >> 32) & (kMostCells - 1);
}

}  // namespace detail

inline std::uint64_t cell_code(CellPlace p) {
    return detail::spread_bits(p[0]) | detail::spread_bits(p[1]) << 1 |
           detail::spread_bits(p[2]) << 2;
}
inline CellPlace cell_place(std::uint64_t code) {
    return {detail::gather_bits(code), detail::gather_bits(code >> 1),
            detail::gather_bits(code >> 2)};
}

/// The finest grid: cubes of size `cell` from the corner `low` on. What lies outside of its 2^21
/// cells an axis counts as in the outermost.
struct MortonGrid {
    Vec3 low;
    double cell;

    std::uint64_t code_at(Vec3 position) const {
        CellPlace place;
        for (int i = 0; i < 3; ++i) {
            const double x = (static_cast<double>(position[i]) - low[i]) / cell;
            place[i] = static_cast<std::uint32_t>(std::clamp(x, 0.0, kMostCells - 1.0));
        }
        return cell_code(place);
    }
};

}  // namespace chiaro
