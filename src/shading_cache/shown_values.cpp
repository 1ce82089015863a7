#include "shading_cache/shown_values.h"

#include "shading_cache/arrays.h"

#include <algorithm>

namespace chiaro {

void ShownValues::add_vertex(std::size_t part) {
    if (layout_ == Layout::dense)
        append(values_, std::uint32_t{0}, part);
    else if (count_++ % kBlock == 0)
        append(blocks_, kNone, part);
}

void ShownValues::set(VertexId vertex, std::uint32_t bits) {
    const std::size_t i = index_of(vertex);
    if (layout_ == Layout::dense) {
        values_[i] = bits;
        return;
    }
    std::uint32_t& block = blocks_[i / kBlock];
    if (block == kNone) {
        if (bits == 0) return;
        block = static_cast<std::uint32_t>(values_.size());
        for (std::size_t k = 0; k < kBlock; ++k) append(values_, std::uint32_t{0});
    }
    values_[block + i % kBlock] = bits;
}

void ShownValues::clear_values() {
    if (layout_ == Layout::dense) {
        std::fill(values_.begin(), values_.end(), 0u);
        return;
    }
    values_ = {};
    std::fill(blocks_.begin(), blocks_.end(), kNone);
}

void ShownValues::pack(const std::vector<char>& kept) {
    if (layout_ == Layout::dense) {
        keep_only(values_, kept);
        return;
    }
    ShownValues packed(layout_);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (!kept[i]) continue;
        packed.add_vertex(kBlock);
        packed.set(static_cast<VertexId>(packed.count_ - 1), of(static_cast<VertexId>(i)));
    }
    packed.blocks_.shrink_to_fit();
    packed.values_.shrink_to_fit();
    *this = std::move(packed);
}

std::size_t ShownValues::bytes() const {
    return bytes_of(blocks_) + bytes_of(values_);
}

}  // namespace chiaro
