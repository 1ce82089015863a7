// Selection against equation 1 and the words of 4.2 to 4.4. Rates of n tests have a standard
// deviation of at most sqrt(p (1 - p) / n); bounds are 6 of these, a false alarm of 2e-9 each.
#include "sample_selector/select_samples.h"

#include "sample_selector/priorities.h"

#include <gtest/gtest.h>

#include <array>

#include <cmath>
#include <set>

namespace chiaro {
namespace {

using namespace tiny;

void expect_rate(double rate, double p, double n) {
    EXPECT_NEAR(rate, p, 6 * std::sqrt(p * (1 - p) / n));
}

// Of all tests, a pixel's share is accepted as equation 1 says, and a share of epsilon by chance.
TEST(HitAndTest, AcceptanceRateIsEquationOne) {
    const PriorityMap map = strips({{400, 0.1f}, {300, 0.3f}, {200, 0.5f}, {100, 0.9f}}, 100);
    constexpr float kEpsilon = 0.03f;
    const auto [selected, tests] = counted_hit_and_test(map, 100'000, kEpsilon, 1);
    ASSERT_EQ(selected.size(), 100'000u);

    const PriorityRange range = four_sigma_range(map.patch_priorities);
    std::array<double, 4> counts = {};
    double by_chance = 0;
    for (const SelectedPixel& s : selected) {
        counts[index_of(map.patches[s.pixel])] += 1;
        by_chance += s.by == SelectedBy::chance ? 1 : 0;
        EXPECT_NE(s.by, SelectedBy::flood_fill);
    }
    const std::array<double, 4> areas = {0.4, 0.3, 0.2, 0.1};
    double total = 0;
    for (int i = 0; i < 4; ++i) {
        const double accept = kEpsilon + (1 - kEpsilon) * range.normalize(map.patch_priorities[i]);
        expect_rate(counts[i] / static_cast<double>(tests), areas[i] * accept, double(tests));
        total += areas[i] * accept;
    }
    expect_rate(100'000.0 / static_cast<double>(tests), total, double(tests));
    expect_rate(by_chance / static_cast<double>(tests), kEpsilon, double(tests));
}

// If all patches are alike the average maps to 1/2: epsilon + (1 - epsilon) / 2 are accepted.
TEST(HitAndTest, EqualPrioritiesAreAcceptedAtOneHalf) {
    for (const float priority : {0.0f, 0.37f, 1.0f}) {
        const PriorityMap map = strips({{50, priority}, {50, priority}, {50, priority}}, 10);
        const auto [selected, tests] = counted_hit_and_test(map, 50'000, 0.05f, 2);
        expect_rate(50'000.0 / double(tests), 0.05 + 0.95 / 2, double(tests));
    }
}

// With epsilon 1 every hit is accepted, by chance.
TEST(HitAndTest, EpsilonOneAcceptsEverything) {
    const PriorityMap map = strips({{10, 0.0f}, {10, 1.0f}}, 10);
    const auto [selected, tests] = counted_hit_and_test(map, 1000, 1, 3);
    EXPECT_EQ(tests, 1000u);
    for (const SelectedPixel& s : selected) EXPECT_EQ(s.by, SelectedBy::chance);
}

// Background is never selected, be it most of the view or all.
TEST(HitAndTest, BackgroundIsNeverSelected) {
    std::vector<float> priorities(1000, -1);
    priorities[77] = 0.5f;
    priorities[700] = 0.25f;
    const PriorityMap map = pixels(100, priorities);
    Rng rng(4);
    const auto selected = select_samples(map, {.sample_count = 1000}, rng);
    ASSERT_FALSE(selected.empty());
    for (const SelectedPixel& s : selected) EXPECT_TRUE(s.pixel == 77 || s.pixel == 700);

    const PriorityMap nothing = pixels(10, std::vector<float>(100, -1));
    EXPECT_TRUE(select_samples(nothing, {}, rng).empty());
}

TEST(SelectSamples, SameSeedSameSelection) {
    Rng values(5);
    std::vector<float> priorities(4000);
    for (float& p : priorities) p = values.uniform();
    const PriorityMap map = pixels(80, priorities);
    const auto pick = [&](std::uint64_t seed) {
        Rng rng(seed);
        std::vector<std::uint32_t> picked;
        for (const SelectedPixel& s : select_samples(map, {}, rng)) picked.push_back(s.pixel);
        return picked;
    };
    EXPECT_EQ(pick(1), pick(1));
    EXPECT_NE(pick(1), pick(2));
}

// At most the count asked for, and no more than its share by flood fill.
TEST(SelectSamples, RespectsTheCounts) {
    Rng rng(6);
    std::vector<float> priorities(10'000);
    for (float& p : priorities) p = rng.uniform();
    const PriorityMap map = pixels(100, priorities);
    for (const std::size_t count : {0u, 1u, 2u, 70u, 1001u}) {
        const auto selected =
            select_samples(map, {.sample_count = count, .flood_share = 0.4f}, rng);
        EXPECT_EQ(selected.size(), count);  // a random field has uphill neighbours enough
        std::size_t flooded = 0;
        for (const SelectedPixel& s : selected) flooded += s.by == SelectedBy::flood_fill ? 1 : 0;
        EXPECT_LE(flooded, static_cast<std::size_t>(0.4f * static_cast<float>(count)));
    }
}

// 4.4: a neighbour is taken if its priority is greater than that of the sample it was reached from.
// On a ramp every step up is taken and no step down.
TEST(FloodFill, ClimbsARampAndNeverDescends) {
    std::vector<float> ramp(50);
    for (std::size_t i = 0; i < 50; ++i) ramp[i] = static_cast<float>(i) / 50;
    const auto filled = flood_fill(pixels(50, ramp), {{20, SelectedBy::priority}}, 1000);
    ASSERT_EQ(filled.size(), 29u);
    for (std::uint32_t i = 0; i < 29; ++i) {
        EXPECT_EQ(filled[i].pixel, 21 + i);
        EXPECT_EQ(filled[i].by, SelectedBy::flood_fill);
    }
}

// Equal is not greater: inside one patch nothing is filled.
TEST(FloodFill, StaysWithinNoPlateau) {
    const PriorityMap map = strips({{400, 0.5f}}, 20);
    EXPECT_TRUE(flood_fill(map, {{210, SelectedBy::priority}}, 1000).empty());
}

// Rows do not run into each other: the last pixel of a row is no neighbour of the next row's first.
TEST(FloodFill, StopsAtTheBorders) {
    const PriorityMap map = pixels(3, {0.1f, 0.1f, 0.1f,    //
                                       0.9f, 0.05f, 0.05f,  //
                                       0.05f, 0.05f, 0.05f});
    EXPECT_TRUE(flood_fill(map, {{2, SelectedBy::priority}}, 10).empty());
    EXPECT_EQ(flood_fill(map, {{0, SelectedBy::priority}}, 10).size(), 1u);
}

// Every pixel filled touches one of lower priority that is selected already; none is taken twice,
// none is background, and the count is kept.
TEST(FloodFill, GoesUphillOnceFromTheSelected) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Rng rng(seed);
        std::vector<float> priorities(64 * 48);
        for (float& p : priorities) p = rng.below(10) == 0 ? -1 : rng.uniform();
        const PriorityMap map = pixels(64, priorities);
        const auto selected = hit_and_test(map, 60, 0.03f, rng);
        const std::size_t count = seed % 2 == 0 ? 100000 : 40;
        const auto filled = flood_fill(map, selected, count);
        EXPECT_LE(filled.size(), count);
        EXPECT_FALSE(filled.empty());

        std::set<std::uint32_t> taken;
        for (const SelectedPixel& s : selected) taken.insert(s.pixel);
        for (const SelectedPixel& s : filled) {
            EXPECT_NE(map.patches[s.pixel], PatchId::none);
            bool reached = false;
            const std::uint32_t x = s.pixel % 64, y = s.pixel / 64;
            const auto from = [&](std::uint32_t neighbour) {
                reached |= taken.count(neighbour) && priorities[neighbour] < priorities[s.pixel];
            };
            if (x > 0) from(s.pixel - 1);
            if (x < 63) from(s.pixel + 1);
            if (y > 0) from(s.pixel - 64);
            if (y < 47) from(s.pixel + 64);
            EXPECT_TRUE(reached);
            EXPECT_TRUE(taken.insert(s.pixel).second);
        }
    }
}

// 3.1: the list of selected patches holds each once, those with more samples first.
TEST(CountByPatch, MostSamplesFirst) {
    const PriorityMap map = strips({{4, 0.1f}, {4, 0.2f}, {4, 0.3f}}, 12);
    std::vector<SelectedPixel> selection;
    for (const std::uint32_t pixel : {1u, 9u, 5u, 6u, 11u, 7u})
        selection.push_back({pixel, SelectedBy::priority});
    const auto patches = count_by_patch(map, selection);
    ASSERT_EQ(patches.size(), 3u);
    const std::array<std::pair<std::uint32_t, int>, 3> expected = {{{1, 3}, {2, 2}, {0, 1}}};
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(patches[i].patch, static_cast<PatchId>(expected[i].first));
        EXPECT_EQ(patches[i].samples, expected[i].second);
    }
}

}  // namespace
}  // namespace chiaro
