// Finds the vertices of a level that are near a cell of its grid.
#pragma once

#include "shading_cache/representatives.h"

namespace chiaro {

/// An index of vertices in the order of their cells, which must outlive it, by blocks of 2^3 cells:
/// the cells next to one are all in 8 of these.
class NearVertices {
public:
    NearVertices(std::span<const LevelVertex> vertices, const LevelGrid& grid);

    /// Puts in `found` the vertices in the 8 blocks nearest the cell: all those in the cells next
    /// to it, and some a cell further away. Of more than 128 only those of the first blocks, its
    /// own before others.
    void find(std::uint64_t cell, std::vector<LevelVertex>& found) const;

private:
    std::span<const LevelVertex> in_block(std::uint64_t code) const;

    std::span<const LevelVertex> vertices_;
    std::vector<std::uint64_t> codes_;  // of blocks
    std::vector<std::uint32_t> first_;  // vertex of each block, and the end of the last
    std::vector<std::uint32_t> start_;  // the first block whose code >> start_shift_ is the index
    int start_shift_ = 0;
};

}  // namespace chiaro
