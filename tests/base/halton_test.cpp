#include "base/halton.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace chiaro {
namespace {

TEST(Halton, FirstPointsAreThoseOfTheDefinition) {
    // Digits of the index mirrored at the radix point: 6 = 110 in base 2 -> 0.011 = 3/8.
    const std::array<float, 8> base2 = {0,       1 / 2.f, 1 / 4.f, 3 / 4.f,
                                        1 / 8.f, 5 / 8.f, 3 / 8.f, 7 / 8.f};
    const std::array<float, 8> base3 = {0,       1 / 3.f, 2 / 3.f, 1 / 9.f,
                                        4 / 9.f, 7 / 9.f, 2 / 9.f, 5 / 9.f};
    for (std::uint32_t i = 0; i < 8; ++i) {
        EXPECT_FLOAT_EQ(halton(0, i), base2[i]);
        EXPECT_FLOAT_EQ(halton(1, i), base3[i]);
    }
    EXPECT_FLOAT_EQ(halton(2, 6), 1 / 5.f + 1 / 25.f);            // 11 in base 5
    EXPECT_FLOAT_EQ(halton(7, 20), 1 / 19.f + 1 / 361.f);         // 11 in base 19
    EXPECT_FLOAT_EQ(halton(0, 1U << 20), std::ldexp(1.0f, -21));  // far beyond any table
}

TEST(Halton, StaysBelowOneAtTheLargestIndex) {
    for (int d = 0; d < kHaltonDimensions; ++d) {
        EXPECT_LT(halton(d, 0xffff'ffffU), 1.0f);
        EXPECT_GE(halton(d, 0xffff'ffffU), 0.0f);
    }
}

// The first b^k points of base b fall one into each of the b^k equal intervals: nothing is more
// even.
TEST(Halton, EachDimensionIsPerfectlyStratified) {
    const std::array<std::uint32_t, 8> bases = {2, 3, 5, 7, 11, 13, 17, 19};
    for (int d = 0; d < kHaltonDimensions; ++d) {
        const std::uint32_t count = bases[d] * bases[d];
        std::vector<int> hits(count, 0);
        for (std::uint32_t i = 0; i < count; ++i) {
            // Half an interval up, so that a point on a boundary is not rounded across it.
            const auto cell =
                static_cast<std::size_t>(halton(d, i) * static_cast<float>(count) + 0.5f);
            ASSERT_LT(cell, count);
            ++hits[cell];
        }
        for (const int h : hits) EXPECT_EQ(h, 1) << "base " << bases[d];
    }
}

// Integrates x y over the unit square (1/4). 4096 random points would err by 0.0034 (one sigma);
// Halton's two first dimensions err by less than a fifth of that.
TEST(Halton, IntegratesTheSquareFiveTimesBetterThanChance) {
    double sum = 0;
    for (std::uint32_t i = 0; i < 4096; ++i) sum += halton(0, i) * halton(1, i);
    EXPECT_NEAR(sum / 4096, 0.25, 0.00068);
}

TEST(Halton, RotationWrapsRoundAndStaysInTheUnitInterval) {
    EXPECT_FLOAT_EQ(rotate_unit(0.25f, 0.5f), 0.75f);
    EXPECT_FLOAT_EQ(rotate_unit(0.75f, 0.5f), 0.25f);
    EXPECT_FLOAT_EQ(rotate_unit(0.5f, 0.5f), 0.0f);
    const float below_one = 0x1.fffffep-1f;
    EXPECT_LT(rotate_unit(below_one, below_one), 1.0f);
    EXPECT_GE(rotate_unit(below_one, 0x1p-24f), 0.0f);
    EXPECT_LT(rotate_unit(below_one, 0x1p-26f), 1.0f);
}

}  // namespace
}  // namespace chiaro
