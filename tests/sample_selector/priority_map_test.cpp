// Priorities of patches and how they are brought to [0, 1].
#include "sample_selector/priority_map.h"

#include "base/tone_map.h"
#include "shading_cache/cache_testing.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

// 4.2: four standard deviations below and above the average become 0 and 1. Of 0, 0.5 and 1 the
// average is 1/2 and the variance 1/6.
TEST(PriorityRange, IsFourStandardDeviationsEitherWay) {
    const std::vector<float> priorities = {0, 0.5f, 1};
    const PriorityRange range = four_sigma_range(priorities);
    EXPECT_NEAR(range.low, 0.5 - 4 * std::sqrt(1.0 / 6), 1e-6);
    EXPECT_NEAR(range.high, 0.5 + 4 * std::sqrt(1.0 / 6), 1e-6);
    EXPECT_NEAR(range.normalize(0.5f), 0.5f, 1e-6f);
    EXPECT_NEAR(range.normalize(range.low), 0, 1e-6f);
    EXPECT_NEAR(range.normalize(range.high), 1, 1e-6f);
    EXPECT_NEAR(range.normalize(1) - range.normalize(0), 1 / (8 * std::sqrt(1.0 / 6)), 1e-5);
}

// Outliers are clamped; 1 among 999 zeros is far beyond four deviations.
TEST(PriorityRange, ClampsOutliers) {
    std::vector<float> priorities(1000, 0.0f);
    priorities[0] = 1;
    const PriorityRange range = four_sigma_range(priorities);
    EXPECT_EQ(range.normalize(1), 1);
    EXPECT_EQ(range.normalize(-100), 0);
}

// Without any spread the average still maps to 1/2, whatever it is and however many there are.
TEST(PriorityRange, NoSpreadIsOneHalf) {
    for (const float p : {0.0f, 0.1f, 0.3f, 1.0f})
        for (const std::size_t count : {1u, 3u, 7u, 1000u})
            EXPECT_EQ(four_sigma_range(std::vector<float>(count, p)).normalize(p), 0.5f);
}

// 4.1: largest minus smallest of the corners' tone-mapped colours, at the patch's reflectance.
TEST(InterpolationError, IsTheRangeOfTheTonesOfTheCorners) {
    const Scene scene = grid(1, 1);  // reflectance 0.5
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId root = front_roots(cache)[0];
    const std::array<Rgb, 4> light = {Rgb(4, 0, 0), Rgb(1), Rgb(0, 8, 0), Rgb(2, 2, 2)};
    EXPECT_EQ(interpolation_error(cache, cache.patch(root), {}), 1);  // nothing is known
    for (int c = 0; c < 3; ++c) cache.store(cache.patch(root).corners[c], 0, light[c], 0, 1, 1);
    EXPECT_EQ(interpolation_error(cache, cache.patch(root), {}), 1);  // not of all corners
    cache.store(cache.patch(root).corners[3], 0, light[3], 0, 1, 1);

    for (const float exposure : {0.1f, 1.0f, 20.0f}) {
        float low = 1, high = 0;
        for (const Rgb& e : light) {
            const float tone = paper_tone_value(e, exposure * 128 / 255 / kPi);
            low = std::min(low, tone);
            high = std::max(high, tone);
        }
        EXPECT_NEAR(interpolation_error(cache, cache.patch(root), {exposure}), high - low, 1e-5f);
    }
}

TEST(InterpolationError, IsZeroWhereTheCornersAgree) {
    const Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId root = front_roots(cache)[0];
    store_constant(cache, Rgb(4, 2, 1));
    EXPECT_EQ(interpolation_error(cache, cache.patch(root), {}), 0);
}

// 5.1, 5.2: what is stale ages by its object's rate a cycle, from when its oldest corner was
// shaded; what is not does not, nor does anything on objects that were not found to change.
TEST(AgePriority, GrowsWithTheCyclesSinceAStaleCornerWasShaded) {
    const Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const Patch& root = cache.patch(front_roots(cache)[0]);
    for (int c = 0; c < 4; ++c)
        cache.store(root.corners[c], 0, Rgb(1), 0.1f, 32, static_cast<Cycle>(4 + c));
    const std::vector<float> rates = {1.5f}, none = {0};
    EXPECT_EQ(age_priority(cache, root, {.rates = rates, .now = 16}), 0);
    cache.outdate(root.corners[2], 0, 1);
    EXPECT_EQ(age_priority(cache, root, {.rates = rates, .now = 16}), 1.5f * 10);
    cache.outdate(root.corners[0], 0, 1);
    EXPECT_EQ(age_priority(cache, root, {.rates = rates, .now = 16}), 1.5f * 12);
    EXPECT_EQ(age_priority(cache, root, {.rates = none, .now = 16}), 0);
    EXPECT_EQ(age_priority(cache, root, {}), 0);
}

// Each visible leaf counts once, whatever it covers; pixels without a patch have no priority.
TEST(PriorityMap, CountsVisibleLeavesOnce) {
    Rng rng(1);
    const Scene scene = grid(3, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto roots = front_roots(cache);
    cache.subdivide(roots[0]);
    store_random(cache, rng);
    IdMap map = random_map(cache, {roots[0], roots[1]}, 400, rng);
    map.width = 401;  // and a pixel of background
    map.first_of_pixel.push_back(map.first_of_pixel.back());
    attach(cache, map, 1);

    const PriorityMap priorities = make_priority_map(cache, map, {}, 0);
    EXPECT_EQ(priorities.patch_priorities.size(),
              5u);  // four children and a root; one is not in view
    for (std::uint32_t p = 0; p < 400; ++p) {
        const PatchId leaf = map.at_pixel(p)[0].patch;
        EXPECT_EQ(priorities.patches[p], leaf);
        EXPECT_EQ(priorities.at(p), interpolation_error(cache, cache.patch(leaf), {}));
    }
    EXPECT_FALSE(priorities.at(400).has_value());
}

// A pixel that shows a floor through a pane stands for each in proportion to what it adds: with 0.9
// of the light from the floor, 900 of 1000 turns, give or take 6 standard deviations of 9.5 (false
// alarm 2e-9).
TEST(PriorityMap, APixelOfSeveralLeavesStandsForEachInTurn) {
    Rng rng(1);
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto roots = front_roots(cache);
    IdMap map = random_map(cache, {roots[0]}, 1, rng);
    map.fragments.front().reflectance = Rgb(0.1f);
    Fragment floor = map.fragments.front();
    floor.patch = roots[1];
    floor.reflectance = Rgb(0.9f);
    map.fragments.push_back(floor);
    map.first_of_pixel.back() = 2;
    attach(cache, map, 1);
    int of_floor = 0;
    for (std::uint32_t turn = 0; turn < 1000; ++turn)
        of_floor += make_priority_map(cache, map, {}, turn).patches[0] == roots[1] ? 1 : 0;
    EXPECT_NEAR(of_floor, 900, 57);
}

}  // namespace
}  // namespace chiaro
