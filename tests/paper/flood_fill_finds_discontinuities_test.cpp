// 4.4: small patches along a discontinuity "end up being rarely tested by the hit-and-test
// process"; flood fill "ensures that regions with small, high priority patches will be highly
// sampled".
#include "sample_selector/priorities.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

constexpr int kWidth = 64;

// A shadow's edge down a 64 x 64 picture: a column of one-pixel patches of high priority, between
// patches of 4 x 4 pixels of little, the rest in large flat ones of none.
PriorityMap shadow_edge() {
    PriorityMap map;
    map.width = map.height = kWidth;
    std::vector<char> counted(10'000, 0);
    Rng rng(1);
    for (std::uint32_t y = 0; y < kWidth; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const bool edge = x == 32;
            const bool beside = x >= 28 && x <= 36 && !edge;
            const std::uint32_t patch = edge     ? 1000 + y
                                        : beside ? 2000 + y / 4 * 2 + (x > 32 ? 1 : 0)
                                                 : y / 32 * 2 + (x > 32 ? 1 : 0);
            const float priority = edge ? 0.5f + 0.5f * rng.uniform() : beside ? 0.2f : 0;
            map.patches.push_back(static_cast<PatchId>(patch));
            map.pixel_priorities.push_back(priority);
            if (!counted[patch]) map.patch_priorities.push_back(priority);
            counted[patch] = 1;
        }
    return map;
}

int samples_on_the_edge(const PriorityMap& map, float flood_share) {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Rng rng(seed);
        for (const SelectedPixel& s :
             select_samples(map, {.sample_count = 70, .flood_share = flood_share}, rng))
            count += s.pixel % kWidth == 32 ? 1 : 0;
    }
    return count;
}

// With the same number of samples, both phases put more of them on the edge than hit-and-test
// alone. What that finds in 200 selections is a Poisson number of some hundreds: half as many again
// is no accident.
TEST(PaperFloodFill, FavoursSmallPatchesOfHighPriority) {
    const PriorityMap map = shadow_edge();
    const int alone = samples_on_the_edge(map, 0);
    const int both = samples_on_the_edge(map, 0.5f);
    EXPECT_GT(alone, 200);
    EXPECT_GT(both, 3 * alone / 2);
}

// The first phase still spreads over the picture: half of 1000 samples, of which the two sides of
// the edge have nearly half each, about 230 with a deviation of 11; 5 of these less is 175.
TEST(PaperFloodFill, LeavesTheRestOfThePictureItsSamples) {
    const PriorityMap map = shadow_edge();
    Rng rng(5);
    int left = 0, right = 0;
    for (const SelectedPixel& s : select_samples(map, {.sample_count = 1000}, rng)) {
        left += s.pixel % kWidth < 32 ? 1 : 0;
        right += s.pixel % kWidth > 32 ? 1 : 0;
    }
    EXPECT_GT(left, 175);
    EXPECT_GT(right, 175);
}

}  // namespace
}  // namespace chiaro
