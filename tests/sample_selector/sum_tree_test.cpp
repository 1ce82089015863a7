// Draws in proportion to weights.
#include "sample_selector/sum_tree.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

// Chi^2 of 200,000 draws over 300 weights in 3 levels. 299 degrees: standard deviation 24.5; bound
// 299 + 6 x 24.5, false alarm below 1e-7.
TEST(SumTree, DrawsInProportionToTheWeights) {
    SumTree tree;
    tree.resize(300);
    Rng rng(1);
    double sum = 0;
    for (std::size_t i = 0; i < 300; ++i) {
        tree.set(i, 0.1f + rng.uniform());
        sum += tree.weight(i);
    }
    EXPECT_NEAR(tree.total(), sum, 1e-5 * sum);
    std::vector<double> counts(300, 0);
    constexpr int kDraws = 200'000;
    for (int i = 0; i < kDraws; ++i) counts[tree.draw(rng.uniform())] += 1;
    double chi2 = 0;
    for (std::size_t i = 0; i < 300; ++i) {
        const double expected = kDraws * tree.weight(i) / sum;
        chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
    }
    EXPECT_LT(chi2, 299 + 6 * 24.5);
}

// draw(u) is where the running sum passes u x total: whole weights make that exact.
TEST(SumTree, DrawFollowsTheRunningSum) {
    SumTree tree;
    tree.resize(40);
    for (std::size_t i = 0; i < 40; ++i) tree.set(i, static_cast<float>(i % 4));  // sum 60
    std::size_t expected = 0;
    float running = tree.weight(0);
    for (int k = 0; k < 60; ++k) {
        while (running <= static_cast<float>(k)) running += tree.weight(++expected);
        EXPECT_EQ(tree.draw((static_cast<float>(k) + 0.5f) / 60), expected);
    }
}

// A weight of zero is never drawn, at either end of u.
TEST(SumTree, ZeroWeightsAreNeverDrawn) {
    SumTree tree;
    tree.resize(5000);
    tree.set(1234, 1e-20f);
    tree.set(4321, 3);
    tree.set(4321, 0);
    for (const float u : {0.0f, 0.5f, 1 - 0x1p-24f}) EXPECT_EQ(tree.draw(u), 1234u);
}

// After many settings the sum is that of the weights as they are, of whatever size they were
// before: no rounding gathers.
TEST(SumTree, SumsStayExactAfterManySets) {
    SumTree tree;
    tree.resize(1000);
    Rng rng(2);
    for (int i = 0; i < 200'000; ++i) tree.set(rng.below(1000), std::exp2(60 * rng.uniform() - 30));
    for (std::size_t i = 0; i < 1000; ++i) tree.set(i, static_cast<float>(i % 8));
    EXPECT_EQ(tree.total(), 3500);  // sums of small whole numbers are exact
}

// Many weights set at once leave the same tree as the same weights set one by one: the same draws,
// the same total to the last bit.
TEST(SumTree, SettingManyIsSettingEach) {
    constexpr std::size_t kCount = 9000;  // four levels
    SumTree one_by_one, at_once;
    Rng rng(3);
    std::vector<float> first(kCount);
    for (float& w : first) w = rng.uniform();
    one_by_one.assign(first);
    at_once.assign(first);
    for (const std::uint32_t every : {1u, 7u, 300u, 5000u}) {
        std::vector<std::uint32_t> indices;
        std::vector<float> weights;
        for (std::uint32_t i = every / 2; i < kCount; i += every) {
            indices.push_back(i);
            weights.push_back(10 * rng.uniform());
            one_by_one.set(i, weights.back());
        }
        at_once.set_many(indices, weights);
        EXPECT_EQ(at_once.total(), one_by_one.total());
        for (int k = 0; k < 200; ++k) {
            const float u = rng.uniform();
            EXPECT_EQ(at_once.draw(u), one_by_one.draw(u));
        }
    }
    at_once.set_many({}, {});
    EXPECT_EQ(at_once.total(), one_by_one.total());
}

// Growing keeps the weights that are there, across levels; new ones are zero.
TEST(SumTree, ResizeKeepsWeights) {
    SumTree tree;
    EXPECT_EQ(tree.size(), 0u);
    EXPECT_EQ(tree.total(), 0);
    double sum = 0;
    std::size_t filled = 0;
    for (const std::size_t size : {1u, 3u, 16u, 17u, 256u, 257u, 4096u, 5000u, 70'000u}) {
        tree.resize(size);
        EXPECT_EQ(tree.size(), size);
        EXPECT_EQ(tree.total(), sum);
        EXPECT_EQ(tree.weight(size - 1), 0);
        for (; filled < size; ++filled) {
            tree.set(filled, static_cast<float>(1 + filled % 3));
            sum += static_cast<double>(1 + filled % 3);
        }
        EXPECT_EQ(tree.total(), sum);
    }
    for (std::size_t i = 0; i < filled; ++i)
        ASSERT_EQ(tree.weight(i), static_cast<float>(1 + i % 3));
    tree.clear();
    EXPECT_EQ(tree.size(), 0u);
    EXPECT_EQ(tree.total(), 0);
}

// "Never shrinks except by clear()": a smaller size leaves it as it is.
TEST(SumTree, NeverShrinks) {
    SumTree tree;
    tree.resize(300);
    tree.set(299, 2);
    tree.resize(20);
    EXPECT_EQ(tree.size(), 300u);
    EXPECT_EQ(tree.total(), 2);
}

// 2 bytes a weight and 4 bytes a sum of 16, and of 16 sums: 2 + 4 / 15 a weight, with capacity
// grown by a 64th.
TEST(SumTree, IsSmall) {
    SumTree tree;
    tree.resize(1'000'000);
    EXPECT_LE(tree.bytes(), static_cast<std::size_t>((2 + 4.0 / 15) * 1e6 * 65 / 64 + 4096));
}

}  // namespace
}  // namespace chiaro
