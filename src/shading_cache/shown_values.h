// What the vertices of one channel show, 4 bytes a vertex or, where few show anything, far less.
#pragma once

#include "shading_cache/patch.h"

#include <vector>

namespace chiaro {

/// RGB9E5 values by vertex, 0 until set. Dense ones take 4 bytes a vertex. Sparse ones take 1/2
/// byte a vertex and 4 for each in those blocks of 8 of which one is not 0: vertices of one surface
/// are often made together, and most surfaces have no gloss.
class ShownValues {
public:
    enum class Layout { dense, sparse };
    explicit ShownValues(Layout layout) : layout_(layout) {}

    /// Makes room for one more vertex, which shows 0.
    void add_vertex(std::size_t part);

    std::uint32_t of(VertexId vertex) const {
        const std::size_t i = index_of(vertex);
        if (layout_ == Layout::dense) return values_[i];
        const std::uint32_t block = blocks_[i / kBlock];
        return block == kNone ? 0 : values_[block + i % kBlock];
    }
    void set(VertexId vertex, std::uint32_t bits);

    /// All values that are not 0, and others that are: what maps 0 to 0 may be done to them.
    std::span<std::uint32_t> values() { return values_; }
    /// All vertices show 0.
    void clear_values();
    /// Keeps the vertices that are marked, in order.
    void pack(const std::vector<char>& kept);

    std::size_t bytes() const;

private:
    static constexpr std::size_t kBlock = 8;
    static constexpr std::uint32_t kNone = 0xffff'ffff;

    Layout layout_;
    std::size_t count_ = 0;              // vertices, where sparse
    std::vector<std::uint32_t> blocks_;  // of kBlock vertices each: where they are in values_
    std::vector<std::uint32_t> values_;
};

}  // namespace chiaro
