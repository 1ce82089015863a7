// Lower resolution where shading changes (5.3), on one square and its children.
#include "update/lower_resolution.h"

#include "shading_cache/cache_testing.h"

namespace chiaro {
namespace {

using namespace tiny;

// A square of 64 pixels in four of 16, the first of these in four of 4; all vertices are stale.
struct Square {
    Scene scene = grid(1, 1);
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache{scene, graphs, {1}, SplitRule::always_four};
    PatchId root = cache.root(ObjectId{0}, 0, true);
    PatchId child = divided(root, 64);
    PatchId grandchild = divided(child, 16);
    std::vector<char> changing = {1};

    Square() {
        cache.patch(root).pixels = 64;
        for (std::size_t i = 0; i < cache.vertices().size(); ++i) {
            const auto id = static_cast<VertexId>(i);
            cache.store(id, 0, Rgb(8), 0.25f, 64, 1);
            cache.outdate(id, 0, 1);
        }
    }
    Square(const Square&) = delete;
    Square& operator=(const Square&) = delete;

    PatchId divided(PatchId patch, float pixels) {
        const PatchId first = cache.subdivide(patch);
        cache.patch(patch).refined_channels = 1;
        for (int i = 0; i < 4; ++i) cache.patch(offset_by(first, i)).pixels = pixels / 4;
        return first;
    }
    int evaluated() const {
        int count = 0;
        for (std::size_t i = 0; i < cache.vertices().size(); ++i)
            count += cache.evaluated(static_cast<VertexId>(i), 0) ? 1 : 0;
        return count;
    }
};

// Of 14 vertices (4, then 5, then 5 more) there is time for nine: the finest square is refined no
// longer, and all that was stale is to be evaluated anew.
TEST(LowerResolution, TheFinestPatchesGoFirst) {
    Square s;
    ASSERT_EQ(s.evaluated(), 14);
    EXPECT_EQ(lower_resolution(s.cache, 0, s.changing, 9), 14u);
    EXPECT_EQ(s.evaluated(), 0);
    EXPECT_TRUE(s.cache.patch(s.root).refined(0));
    EXPECT_FALSE(s.cache.patch(s.child).refined(0));
}

// Of two squares beside each other, 64 pixels and 4, there is time for the larger one's corners:
// the two that the smaller one has alone show what they showed.
TEST(LowerResolution, WhatCannotBePaidWaits) {
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    cache.patch(cache.root(ObjectId{0}, 0, true)).pixels = 64;
    cache.patch(cache.root(ObjectId{0}, 1, true)).pixels = 4;
    ASSERT_EQ(cache.vertices().size(), 6u);
    for (std::size_t i = 0; i < cache.vertices().size(); ++i) {
        cache.store(static_cast<VertexId>(i), 0, Rgb(8), 0.25f, 64, 1);
        cache.outdate(static_cast<VertexId>(i), 0, 1);
    }
    EXPECT_EQ(lower_resolution(cache, 0, std::vector<char>{1}, 4, Rest::waits), 4u);
    const Patch& smaller = cache.patch(cache.root(ObjectId{0}, 1, true));
    int known = 0;
    for (int c = 0; c < 4; ++c) known += cache.evaluated(smaller.corners[c], 0) ? 1 : 0;
    EXPECT_EQ(known, 2);
    EXPECT_EQ(lower_resolution(cache, 0, std::vector<char>{1}, 4), 2u);
}

// With time for four alone, the square is one patch again; with time for all, it stays as fine.
TEST(LowerResolution, AsFineAsTheTimeCanPay) {
    Square coarse;
    lower_resolution(coarse.cache, 0, coarse.changing, 4);
    EXPECT_FALSE(coarse.cache.patch(coarse.root).refined(0));
    Square fine;
    EXPECT_EQ(lower_resolution(fine.cache, 0, fine.changing, 14), 14u);
    EXPECT_TRUE(fine.cache.patch(fine.root).refined(0));
    EXPECT_TRUE(fine.cache.patch(fine.child).refined(0));
}

// What is not stale, or lies on an object whose shading hardly changes, stays as it is.
TEST(LowerResolution, WhatDoesNotChangeStays) {
    Square s;
    s.changing = {0};
    EXPECT_EQ(lower_resolution(s.cache, 0, s.changing, 4), 0u);
    EXPECT_EQ(s.evaluated(), 14);

    s.changing = {1};
    for (std::size_t i = 0; i < s.cache.vertices().size(); ++i)
        s.cache.store(static_cast<VertexId>(i), 0, Rgb(4), 0.25f, 64, 2);
    EXPECT_EQ(lower_resolution(s.cache, 0, s.changing, 4), 0u);
    EXPECT_TRUE(s.cache.patch(s.child).refined(0));
    EXPECT_EQ(s.evaluated(), 14);
}

}  // namespace
}  // namespace chiaro
