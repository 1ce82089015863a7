#include "base/random.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <vector>

namespace chiaro {
namespace {

// Pearson's statistic of counts that should all be `expected`.
double chi_squared(const std::vector<int>& counts, double expected) {
    double sum = 0;
    for (const int c : counts) sum += (c - expected) * (c - expected) / expected;
    return sum;
}

// Statistical tests have fixed seeds: they never flicker. Over all seeds a sound generator would
// fail with the probability given.

TEST(Rng, UniformIsUniform) {
    constexpr int kBins = 64;
    constexpr int kSamples = 64'000;
    std::vector<int> counts(kBins, 0);
    Rng rng(1);
    for (int i = 0; i < kSamples; ++i) ++counts[static_cast<int>(rng.uniform() * kBins)];
    // 63 degrees of freedom: exceeded with probability 0.001.
    EXPECT_LT(chi_squared(counts, kSamples / kBins), 103.4);
}

TEST(Rng, BelowIsUniformForABoundThatIsNoPowerOfTwo) {
    std::vector<int> counts(7, 0);
    Rng rng(2);
    for (int i = 0; i < 70'000; ++i) ++counts[rng.below(7)];
    // 6 degrees of freedom: exceeded with probability 0.001.
    EXPECT_LT(chi_squared(counts, 10'000), 22.46);
}

TEST(Rng, PairsFillTheSquareEvenly) {
    std::vector<int> counts(16 * 16, 0);
    Rng rng(3);
    for (int i = 0; i < 128'000; ++i) {
        const int x = static_cast<int>(rng.uniform() * 16);
        ++counts[16 * x + static_cast<int>(rng.uniform() * 16)];
    }
    // 255 degrees of freedom: exceeded with probability 0.001.
    EXPECT_LT(chi_squared(counts, 500), 330.5);
}

TEST(Rng, OneSeedGivesOneSequenceAndEachStreamItsOwn) {
    Rng a(7), b(7), other_seed(8), other_stream(7, 1);
    int equal_seed = 0;
    int equal_stream = 0;
    for (int i = 0; i < 1000; ++i) {
        const std::uint32_t value = a.next();
        EXPECT_EQ(value, b.next());
        equal_seed += value == other_seed.next();
        equal_stream += value == other_stream.next();
    }
    EXPECT_LE(equal_seed, 1);  // two equal values in 1000 by chance: 3e-14
    EXPECT_LE(equal_stream, 1);
}

// Flipping one input bit flips each output bit half of the time.
TEST(Hash, EveryInputBitReachesEveryOutputBit) {
    constexpr int kTrials = 4000;
    for (int in = 0; in < 32; ++in) {
        std::array<int, 32> flips = {};
        for (std::uint32_t i = 0; i < kTrials; ++i) {
            const std::uint32_t x = i * 2654435761U;
            const std::uint32_t changed = hash32(x) ^ hash32(x ^ (1U << in));
            for (int out = 0; out < 32; ++out) flips[out] += (changed >> out) & 1;
        }
        // 6 sigma of a fair coin: 0.05; 1024 coins fail with probability 2e-6.
        for (const int f : flips) EXPECT_NEAR(f, kTrials / 2, 0.05 * kTrials);
    }
}

TEST(Hash, OrderOfTheTwoArgumentsMatters) {
    int equal = 0;
    for (std::uint32_t i = 1; i < 1000; ++i) equal += hash32(i, 2 * i) == hash32(2 * i, i);
    EXPECT_EQ(equal, 0);
}

TEST(Hash, UnitFloatsCoverZeroToJustBelowOne) {
    EXPECT_EQ(to_unit_float(0), 0.0f);
    EXPECT_EQ(to_unit_float(0x8000'0000U), 0.5f);
    EXPECT_LT(to_unit_float(0xffff'ffffU), 1.0f);
    EXPECT_GT(to_unit_float(0xffff'ffffU), 0.9999999f);
}

}  // namespace
}  // namespace chiaro
