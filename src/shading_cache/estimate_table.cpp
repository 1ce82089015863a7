#include "shading_cache/estimate_table.h"

#include "base/error.h"
#include "shading_cache/arrays.h"

#include <algorithm>
#include <bit>

namespace chiaro {

void EstimateTable::add_vertex(std::size_t part) {
    append(first_, std::uint32_t{0}, part);
    append(known_, std::uint8_t{0}, part);
}

std::uint32_t EstimateTable::new_block(int size) {
    auto& unused = unused_[size];
    if (!unused.empty()) {
        const std::uint32_t block = unused.back();
        unused.pop_back();
        return block;
    }
    const auto block = static_cast<std::uint32_t>(estimates_.size());
    for (int i = 0; i < size; ++i) append(estimates_, Estimate{});
    return block;
}

// Into a block that is large enough for other channels; what both know goes along.
void EstimateTable::move_to(VertexId vertex, std::uint8_t known) {
    std::uint32_t& first = first_[index_of(vertex)];
    const std::uint32_t before = first;
    const std::uint8_t known_before = known_[index_of(vertex)];
    if (known != 0) first = new_block(std::popcount(known));
    for (int c = 0; c < kMostChannels; ++c)
        if ((known & known_before) >> c & 1)
            estimates_[first + count_below(known, c)] =
                estimates_[before + count_below(known_before, c)];
    if (known_before != 0) unused_[std::popcount(known_before)].push_back(before);
    known_[index_of(vertex)] = known;
}

void EstimateTable::add(VertexId vertex, int channel, const Estimate& estimate) {
    const std::uint8_t known = known_[index_of(vertex)];
    check((known >> channel & 1) == 0, "EstimateTable: the channel is known there already");
    move_to(vertex, static_cast<std::uint8_t>(known | 1u << channel));
    *find(vertex, channel) = estimate;
}

void EstimateTable::forget(VertexId vertex, std::uint8_t channels) {
    const std::uint8_t known = known_[index_of(vertex)];
    if ((known & channels) != 0) move_to(vertex, static_cast<std::uint8_t>(known & ~channels));
}

void EstimateTable::pack(const std::vector<char>& kept) {
    std::vector<Estimate> packed;
    std::size_t total = 0;
    for (std::size_t v = 0; v < kept.size(); ++v)
        if (kept[v]) total += static_cast<std::size_t>(std::popcount(known_[v]));
    packed.reserve(total);
    for (std::size_t v = 0; v < kept.size(); ++v) {
        if (!kept[v]) continue;
        const Estimate* block = estimates_.data() + first_[v];
        first_[v] = static_cast<std::uint32_t>(packed.size());
        packed.insert(packed.end(), block, block + std::popcount(known_[v]));
    }
    estimates_ = std::move(packed);
    unused_ = {};
    keep_only(first_, kept);
    keep_only(known_, kept);
}

std::size_t EstimateTable::bytes() const {
    std::size_t total = bytes_of(first_) + bytes_of(known_) + bytes_of(estimates_);
    for (const auto& unused : unused_) total += bytes_of(unused);
    return total;
}

}  // namespace chiaro
