// 4.3: "we accept samples with a certain small probability, epsilon, irrespective of their
// priority".
#include "sample_selector/priorities.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

// A patch whose corners agree (priority 0) among 99 that differ alike: it lies ten deviations below
// the average and is normalised to 0. It is selected all the same, with the chance epsilon a hit,
// for every epsilon that the paper names. Poisson: 6 deviations, false alarm 2e-9.
TEST(PaperUnbiased, AFlatPatchIsSelectedWithTheChanceEpsilon) {
    std::vector<Strip> patches(100, {10, 1.0f});
    patches[42].priority = 0;
    const PriorityMap map = strips(patches, 100);
    EXPECT_EQ(four_sigma_range(map.patch_priorities).normalize(0), 0);
    for (const float epsilon : {0.01f, 0.03f, 0.05f}) {
        const auto [selected, tests] = counted_hit_and_test(map, 300'000, epsilon, 1);
        double hits = 0;
        for (const SelectedPixel& s : selected) {
            if (index_of(map.patches[s.pixel]) != 42) continue;
            hits += 1;
            EXPECT_EQ(s.by, SelectedBy::chance);
        }
        const double expected = static_cast<double>(tests) * 0.01 * epsilon;
        EXPECT_NEAR(hits, expected, 6 * std::sqrt(expected));
    }
}

// Chance does not look at the priority: of what it accepts, each patch has its part of the area.
TEST(PaperUnbiased, ChanceIsBlindToPriority) {
    const PriorityMap map = strips({{600, 0.0f}, {300, 0.5f}, {100, 1.0f}}, 100);
    Rng rng(2);
    std::array<double, 3> counts = {};
    double all = 0;
    for (const SelectedPixel& s : hit_and_test(map, 400'000, 0.05f, rng)) {
        if (s.by != SelectedBy::chance) continue;
        counts[index_of(map.patches[s.pixel])] += 1;
        all += 1;
    }
    const std::array<double, 3> areas = {0.6, 0.3, 0.1};
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(counts[i] / all, areas[i], 6 * std::sqrt(areas[i] * (1 - areas[i]) / all));
}

}  // namespace
}  // namespace chiaro
