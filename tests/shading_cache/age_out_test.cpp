// The aging rule of 3.1.
#include "shading_cache/age_out.h"

#include "shading_cache/cache_testing.h"

namespace chiaro {
namespace {

using namespace tiny;

// Two squares, each divided into 1 + 4 + 16 patches below which fragments lie, and looked at once.
struct Seen {
    Scene scene = grid(2, 1);
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache;
    Rng rng{1};

    Seen() : cache(scene, graphs, {1}, SplitRule::always_four) {
        front_roots(cache);
        for (int n = 0; n < 2; ++n)
            for (const PatchId leaf : leaves(cache)) cache.subdivide(leaf);
        store_constant(cache, Rgb(1));
        look({true, true}, 2000, 1);
    }
    Seen(const Seen&) = delete;
    Seen& operator=(const Seen&) = delete;

    PatchId root(std::uint32_t i) { return cache.root(ObjectId{0}, i, true); }
    void look(std::array<bool, 2> at, int fragments, Cycle now) {
        std::vector<PatchId> roots;
        for (std::uint32_t i = 0; i < 2; ++i)
            if (at[i]) roots.push_back(root(i));
        IdMap map = random_map(cache, roots, fragments, rng);
        attach(cache, map, now);
    }
};
constexpr AgingSettings kNoMemory = {.budget_bytes = 0, .unseen_cycles = 10};

// Within the budget nothing goes, however old.
TEST(AgeOut, DoesNothingWithinTheBudget) {
    Seen s;
    s.look({true, false}, 2000, 5);
    const std::size_t patches = s.cache.patches().size();
    EXPECT_FALSE(age_out(s.cache, {.budget_bytes = s.cache.bytes(), .unseen_cycles = 1}, 1000));
    EXPECT_EQ(s.cache.patches().size(), patches);
    EXPECT_TRUE(age_out(s.cache, {.budget_bytes = s.cache.bytes() - 1, .unseen_cycles = 1}, 1000));
}

// (a): above it, children that were not seen in N cycles go, counted from when they left the view;
// those in view stay, though their mark is as old. 42 patches are 21 + 21; 1 + 21 are left.
TEST(AgeOut, DeletesWhatWasNotSeenInTime) {
    Seen s;
    s.look({true, false}, 2000, 5);
    EXPECT_FALSE(age_out(s.cache, kNoMemory, 15));  // in view until cycle 5: 10 cycles ago
    const std::size_t bytes = s.cache.bytes();
    EXPECT_TRUE(age_out(s.cache, kNoMemory, 16));
    EXPECT_EQ(s.cache.patches().size(), 1u + 21);
    EXPECT_TRUE(s.cache.patch(s.root(1)).is_leaf());
    EXPECT_FALSE(s.cache.patch(s.root(0)).is_leaf());
    EXPECT_LT(s.cache.bytes(), bytes);
    expect_consistent(s.cache);
    EXPECT_FALSE(age_out(s.cache, kNoMemory, 500));  // what is left is in view
}

// (b): "the patch itself projects to less than one pixel": children below a single fragment go.
TEST(AgeOut, DeletesBelowOnePixel) {
    Seen s;
    s.look({true, false}, 1, 1);
    EXPECT_TRUE(age_out(s.cache, kNoMemory, 1));
    EXPECT_TRUE(s.cache.patch(s.root(0)).is_leaf());
    EXPECT_EQ(s.cache.patches().size(), 1u + 21);  // square 1 was seen in this cycle
}

// Values of what stays are as before; what went is predicted no more and known no more.
TEST(AgeOut, KeepsTheValuesOfWhatStays) {
    Seen s;
    s.look({true, false}, 2000, 5);
    age_out(s.cache, kNoMemory, 100);
    for (std::uint32_t v = 0; v < s.cache.vertices().size(); ++v) {
        const auto id = static_cast<VertexId>(v);
        ASSERT_TRUE(s.cache.evaluated(id, 0));
        EXPECT_EQ(s.cache.shown(id, 0).value, Rgb(1));
    }
    EXPECT_EQ(s.cache.vertices().size(), 25u + 2);  // 5 x 5 of one square, 2 corners of the other
}

}  // namespace
}  // namespace chiaro
