// Values by vertex: sparse ones tell the same as dense ones, in less room.
#include "shading_cache/shown_values.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chiaro {
namespace {

constexpr std::uint32_t kVertices = 10'000;

// After any values are set, forgotten and packed, both layouts tell the same of every vertex.
TEST(ShownValues, SparseOnesTellWhatDenseOnesDo) {
    Rng rng(1);
    ShownValues dense(ShownValues::Layout::dense), sparse(ShownValues::Layout::sparse);
    std::size_t count = 0;
    const auto expect_same = [&] {
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(dense.of(VertexId{i}), sparse.of(VertexId{i})) << i;
    };
    for (int round = 0; round < 4; ++round) {
        for (std::uint32_t i = 0; i < kVertices; ++i, ++count) {
            dense.add_vertex(64);
            sparse.add_vertex(64);
        }
        for (int k = 0; k < 3000; ++k) {
            const VertexId id{rng.below(static_cast<std::uint32_t>(count))};
            const std::uint32_t bits = rng.below(3);
            dense.set(id, bits);
            sparse.set(id, bits);
        }
        expect_same();
        std::vector<char> kept(count);
        for (char& keep : kept) keep = rng.below(3) != 0 ? 1 : 0;
        dense.pack(kept);
        sparse.pack(kept);
        count = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), 1));
        expect_same();
    }
    dense.clear_values();
    sparse.clear_values();
    expect_same();
}

// Where one run of 16 vertices in 100 shows anything, a vertex takes 1/2 byte, and 4 for each of up
// to 24 that share blocks with these, instead of 4 each; and the same again once packed.
TEST(ShownValues, SparseOnesAreSmall) {
    ShownValues sparse(ShownValues::Layout::sparse);
    for (std::uint32_t i = 0; i < kVertices; ++i) sparse.add_vertex(64);
    for (std::uint32_t i = 0; i < kVertices; ++i)
        if (i % 100 < 16) sparse.set(VertexId{i}, 7);
    const double most = 1.1 * kVertices * (0.5 + 4 * 0.24);
    EXPECT_LT(static_cast<double>(sparse.bytes()), most);
    sparse.pack(std::vector<char>(kVertices, 1));
    EXPECT_LT(static_cast<double>(sparse.bytes()), most);
}

}  // namespace
}  // namespace chiaro
