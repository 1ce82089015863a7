// Estimates of several channels at many vertices, kept in blocks that move.

#include "shading_cache/estimate_table.h"
#include "base/random.h"

#include <gtest/gtest.h>
#include <map>

namespace chiaro {
namespace {

using Key = std::pair<std::uint32_t, int>;

Estimate numbered(float n) {
    return {.mean = Rgb(n), .samples = 1};
}

void expect_same(const EstimateTable& table, const std::map<Key, float>& truth, int vertices) {
    for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(vertices); ++v)
        for (int c = 0; c < EstimateTable::kMostChannels; ++c) {
            const Estimate* e = table.find(VertexId{v}, c);
            const auto known = truth.find({v, c});
            ASSERT_EQ(e != nullptr, known != truth.end()) << v << " " << c;
            if (e) {
                ASSERT_EQ(e->mean.x, known->second) << v << " " << c;
            }
        }
}

// Whatever is added, forgotten and packed in whatever order, the table knows what a map would.
TEST(EstimateTable, KnowsWhatAMapWould) {
    constexpr std::uint32_t kVertices = 300;
    EstimateTable table;
    std::map<Key, float> truth;
    for (std::uint32_t v = 0; v < kVertices; ++v) table.add_vertex(64);
    Rng rng(3);
    for (int step = 0; step < 20'000; ++step) {
        const auto v = static_cast<std::uint32_t>(rng.uniform() * kVertices);
        const int c = static_cast<int>(rng.uniform() * EstimateTable::kMostChannels);
        if (rng.uniform() < 0.2f) {
            const auto channels = static_cast<std::uint8_t>(rng.uniform() * 256);
            table.forget(VertexId{v}, channels);
            for (int k = 0; k < EstimateTable::kMostChannels; ++k)
                if (channels >> k & 1) truth.erase({v, k});
        } else if (!table.find(VertexId{v}, c)) {
            const auto n = static_cast<float>(step);
            table.add(VertexId{v}, c, numbered(n));
            truth[{v, c}] = n;
        }
    }
    expect_same(table, truth, kVertices);

    std::vector<char> kept(kVertices);
    for (char& k : kept) k = rng.uniform() < 0.5f;
    std::map<Key, float> packed;
    std::uint32_t next = 0;
    for (std::uint32_t v = 0; v < kVertices; ++v) {
        if (!kept[v]) continue;
        for (int c = 0; c < EstimateTable::kMostChannels; ++c)
            if (truth.contains({v, c})) packed[{next, c}] = truth[{v, c}];
        ++next;
    }
    table.pack(kept);
    expect_same(table, packed, static_cast<int>(next));
}

// Blocks that a vertex has outgrown are used again: 5 bytes a vertex and 20 an estimate, with room
// to grow of a part in 64 and what the list of unused blocks takes.
TEST(EstimateTable, OutgrownBlocksAreUsedAgain) {
    constexpr std::uint32_t kVertices = 100'000;
    EstimateTable table;
    for (std::uint32_t v = 0; v < kVertices; ++v) {
        table.add_vertex(64);
        table.add(VertexId{v}, 1, numbered(1));
        if (v % 2 == 0) table.add(VertexId{v}, 0, numbered(2));
    }
    EXPECT_LT(static_cast<double>(table.bytes()), 1.04 * kVertices * (5 + 20 * 1.5));
}

}  // namespace
}  // namespace chiaro
