// What vertices know, channel by channel: only what was evaluated takes memory.
#pragma once

#include "shading_cache/patch.h"

#include <array>
#include <bit>
#include <utility>
#include <vector>

namespace chiaro {

/// Estimates by vertex and channel. Those of one vertex lie side by side, in order of channels, in
/// a block just large enough; blocks that have become too small are used again for other vertices.
/// So a vertex costs 5 bytes however many channels there are, and each of its estimates 20.
///
/// Pointers are valid until the next add(), clear() or pack().
class EstimateTable {
public:
    static constexpr int kMostChannels = 8;

    /// Makes room for one more vertex, of which nothing is known.
    void add_vertex(std::size_t part);

    const Estimate* find(VertexId vertex, int channel) const {
        const std::uint32_t known = known_[index_of(vertex)];
        if ((known >> channel & 1) == 0) return nullptr;
        return &estimates_[first_[index_of(vertex)] + count_below(known, channel)];
    }
    Estimate* find(VertexId vertex, int channel) {
        return const_cast<Estimate*>(std::as_const(*this).find(vertex, channel));
    }
    /// Bit c: channel c was evaluated there.
    std::uint8_t known(VertexId vertex) const { return known_[index_of(vertex)]; }

    /// Checks: none there yet.
    void add(VertexId vertex, int channel, const Estimate& estimate);
    /// Forgets what is known of some channels (bit c: channel c) at a vertex.
    void forget(VertexId vertex, std::uint8_t channels);

    /// Keeps the vertices that are marked, in order, and no unused blocks.
    void pack(const std::vector<char>& kept);

    std::size_t bytes() const;

private:
    static std::uint32_t count_below(std::uint32_t known, int channel) {
        return static_cast<std::uint32_t>(std::popcount(known & ((1u << channel) - 1)));
    }
    std::uint32_t new_block(int size);
    void move_to(VertexId vertex, std::uint8_t known);

    std::vector<std::uint32_t> first_;  // by vertex: of its block, if anything is known
    std::vector<std::uint8_t> known_;   // by vertex
    std::vector<Estimate> estimates_;
    std::array<std::vector<std::uint32_t>, kMostChannels + 1> unused_;  // blocks by size
};

}  // namespace chiaro
