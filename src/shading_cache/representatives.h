// Which vertices of a level stand for the others in the next coarser one.
#pragma once

#include "shading_cache/parent_weights.h"

#include <vector>

namespace chiaro {

/// A grid of one level: its cells have the codes of the finest grid's >> shift.
struct LevelGrid {
    int shift;
    float cell;  // size, in object space

    std::uint64_t code(const LevelVertex& vertex) const { return vertex.cell >> shift; }
};

/// Calls body(first, end) for each cell whose first vertex is in [begin, end) of `vertices`, which
/// are in the order of their cells.
template <typename Body>
void for_cells(std::span<const LevelVertex> vertices, const LevelGrid& grid, std::size_t begin,
               std::size_t end, const Body& body) {
    const auto continued = [&](std::size_t i) {
        return i > 0 && grid.code(vertices[i]) == grid.code(vertices[i - 1]);
    };
    while (begin < end && continued(begin)) ++begin;
    while (begin < end) {
        std::size_t next = begin + 1;
        while (next < vertices.size() && continued(next)) ++next;
        body(begin, next);
        begin = next;
    }
}

/// For each of `vertices`, which are in the order of their cells, the index of the one in its cell
/// that stands for it, which its surface continues to; its own if that is itself. Representatives
/// get the mean normal of those that they stand for.
std::vector<std::uint32_t> choose_representatives(std::span<LevelVertex> vertices,
                                                  const LevelGrid& grid, int threads);

}  // namespace chiaro
