#include "shading_cache/near_vertices.h"

#include "shading_cache/cell_grid.h"

#include <algorithm>
#include <bit>

namespace chiaro {
namespace {

// Enough for a surface, which has four or so vertices in a block.
constexpr std::size_t kMostFound = 128;

}  // namespace

NearVertices::NearVertices(std::span<const LevelVertex> vertices, const LevelGrid& grid)
    : vertices_(vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint64_t code = grid.code(vertices[i]) >> 3;
        if (!codes_.empty() && codes_.back() == code) continue;
        codes_.push_back(code);
        first_.push_back(static_cast<std::uint32_t>(i));
    }
    first_.push_back(static_cast<std::uint32_t>(vertices.size()));

    const int all_bits = codes_.empty() ? 0 : static_cast<int>(std::bit_width(codes_.back()));
    const int bits = std::min(all_bits, static_cast<int>(std::bit_width(codes_.size())));
    start_shift_ = all_bits - bits;
    start_.resize((std::size_t{1} << bits) + 1);
    std::size_t block = 0;
    for (std::size_t i = 0; i < start_.size(); ++i) {
        while (block < codes_.size() && codes_[block] >> start_shift_ < i) ++block;
        start_[i] = static_cast<std::uint32_t>(block);
    }
}

std::span<const LevelVertex> NearVertices::in_block(std::uint64_t code) const {
    if (codes_.empty() || code > codes_.back()) return {};
    const std::uint64_t bin = code >> start_shift_;
    const auto end = codes_.begin() + start_[bin + 1];
    const auto found = std::lower_bound(codes_.begin() + start_[bin], end, code);
    if (found == end || *found != code) return {};
    const auto block = found - codes_.begin();
    return vertices_.subspan(first_[block], first_[block + 1] - first_[block]);
}

void NearVertices::find(std::uint64_t cell, std::vector<LevelVertex>& found) const {
    found.clear();
    const CellPlace place = cell_place(cell);
    for (int i = 0; i < 8; ++i) {
        CellPlace block;
        bool exists = true;
        for (int axis = 0; axis < 3; ++axis) {
            block[axis] = place[axis] / 2;
            if (!(i >> axis & 1)) continue;
            // The block beyond the side of its own on which the cell is.
            exists &= place[axis] != 0;
            block[axis] += place[axis] % 2 ? 1U : ~0U;
        }
        if (!exists) continue;
        const auto there = in_block(cell_code(block));
        const std::size_t room = kMostFound - found.size();
        found.insert(found.end(), there.begin(),
                     there.begin() + static_cast<std::ptrdiff_t>(std::min(room, there.size())));
    }
}

}  // namespace chiaro
