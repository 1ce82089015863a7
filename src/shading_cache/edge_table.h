// From the two ends of an edge to the vertex that halves it.
#pragma once

#include "base/random.h"
#include "shading_cache/patch.h"

#include <span>
#include <vector>

namespace chiaro {

/// A hash table of vertex ids, 4 bytes an entry: the key of an entry stands in its vertex, whose
/// ends are those of the edge. Open addressing, at most 3/4 full.
class EdgeTable {
public:
    VertexId find(VertexId a, VertexId b, std::span<const CacheVertex> vertices) const {
        if (entries_.empty()) return VertexId::none;
        for (std::size_t i = start(a, b);; i = (i + 1) % entries_.size()) {
            const VertexId entry = entries_[i];
            if (entry == VertexId::none) return entry;
            const auto& ends = vertices[index_of(entry)].ends;
            if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a)) return entry;
        }
    }

    /// Adds a midpoint whose edge is not in the table yet.
    void insert(VertexId midpoint, std::span<const CacheVertex> vertices) {
        if (4 * (count_ + 1) > 3 * entries_.size()) grow(vertices);
        place(midpoint, vertices);
        ++count_;
    }

    void clear() {
        entries_ = std::vector<VertexId>();  // gives the memory back, as clear() would not
        count_ = 0;
    }
    std::size_t bytes() const { return entries_.capacity() * sizeof(VertexId); }

private:
    std::size_t start(VertexId a, VertexId b) const {
        const auto x = static_cast<std::uint32_t>(a), y = static_cast<std::uint32_t>(b);
        const std::uint64_t h = x < y ? hash32(x, y) : hash32(y, x);
        return static_cast<std::size_t>(h * entries_.size() >> 32);
    }
    void place(VertexId midpoint, std::span<const CacheVertex> vertices) {
        const auto& ends = vertices[index_of(midpoint)].ends;
        std::size_t i = start(ends[0], ends[1]);
        while (entries_[i] != VertexId::none) i = (i + 1) % entries_.size();
        entries_[i] = midpoint;
    }
    void grow(std::span<const CacheVertex> vertices) {
        const std::vector<VertexId> old = std::move(entries_);
        entries_.assign(old.size() + old.size() / 3 + 64, VertexId::none);
        for (const VertexId midpoint : old)
            if (midpoint != VertexId::none) place(midpoint, vertices);
    }

    std::vector<VertexId> entries_;
    std::size_t count_ = 0;
};

}  // namespace chiaro
