// 3.1, aging: "if the cache size has grown above a given threshold ... all children of a patch are
// deleted if (a) none of them has been seen in a user-specified number of frames, or, (b) the patch
// itself projects to less than one pixel in the given view."
#include "shading_cache/age_out.h"
#include "shading_cache/cache_testing.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

// A square, divided twice, at which one looks in cycle 1 and away in cycle 2.
struct Aged {
    Scene scene = grid(1, 1);
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache;
    Aged() : cache(scene, graphs, {1}, SplitRule::always_four) {
        const PatchId root = front_roots(cache)[0];
        Rng rng(1);
        IdMap map = random_map(cache, {root}, 500, rng);
        attach(cache, map, 1);
        const PatchId child = subdivide_seen(cache, map, root, 1);
        for (int c = 0; c < 4; ++c) subdivide_seen(cache, map, offset_by(child, c), 1);
        IdMap nothing = random_map(cache, {root}, 0, rng);
        attach(cache, nothing, 2);
    }
    Aged(const Aged&) = delete;
    Aged& operator=(const Aged&) = delete;
};

// (a), for several numbers of frames: children are kept up to that age and gone one cycle later.
TEST(PaperAging, ChildrenLiveAsManyCyclesUnseenAsTheUserSays) {
    for (const Cycle unseen : {0u, 1u, 10u, 1000u}) {
        Aged a;
        const AgingSettings settings = {.budget_bytes = 0, .unseen_cycles = unseen};
        EXPECT_FALSE(age_out(a.cache, settings, 2 + unseen));  // in view until cycle 2
        EXPECT_EQ(a.cache.patches().size(), 21u);
        EXPECT_TRUE(age_out(a.cache, settings, 3 + unseen));
        EXPECT_EQ(a.cache.patches().size(), 1u);
    }
}

// Below the threshold no age is too old.
TEST(PaperAging, NothingGoesBelowTheThreshold) {
    Aged a;
    EXPECT_FALSE(age_out(a.cache, {.budget_bytes = a.cache.bytes(), .unseen_cycles = 0}, 1u << 30));
    EXPECT_EQ(a.cache.patches().size(), 21u);
}

// One child seen in time keeps all four: they are deleted together or not at all. The others' own
// children go.
TEST(PaperAging, OneSeenChildKeepsItsSiblings) {
    Aged a;
    Rng rng(2);
    IdMap map = random_map(a.cache, {a.cache.root(ObjectId{0}, 0, true)}, 50, rng);
    for (Fragment& f : map.fragments) f.local *= 0.25f;  // within the first grandchild
    attach(a.cache, map, 50);
    EXPECT_TRUE(age_out(a.cache, {.budget_bytes = 0, .unseen_cycles = 10}, 50));
    EXPECT_EQ(a.cache.patches().size(), 1u + 4 + 4);
}

// (b): a patch of one pixel needs no children, however lately they were seen.
TEST(PaperAging, PatchesOfOnePixelHaveNoChildren) {
    Aged a;
    Rng rng(3);
    IdMap map = random_map(a.cache, {a.cache.root(ObjectId{0}, 0, true)}, 1, rng);
    attach(a.cache, map, 3);
    EXPECT_TRUE(age_out(a.cache, {.budget_bytes = 0, .unseen_cycles = 1000}, 3));
    EXPECT_EQ(a.cache.patches().size(), 1u);
}

}  // namespace
}  // namespace chiaro
