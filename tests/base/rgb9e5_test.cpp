#include "base/rgb9e5.h"

#include <gtest/gtest.h>

#include "base/random.h"

#include <cmath>

namespace chiaro {
namespace {

TEST(Rgb9e5, PowersOfTwoAndZeroAreExact) {
    for (const float x : {0.0f, 0.25f, 1.0f, 2.0f, 1024.0f})
        EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5({x, 0, x})), Rgb(x, 0, x));
}

TEST(Rgb9e5, ErrsByLessThanHalfAStepOfTheLargestChannel) {
    Rng rng(1);
    for (int i = 0; i < 100'000; ++i) {
        const float size = std::exp2(24 * rng.uniform() - 10);
        const Rgb color = size * Rgb(rng.uniform(), rng.uniform(), rng.uniform());
        const Rgb error = glm::abs(unpack_rgb9e5(pack_rgb9e5(color)) - color);
        // The largest channel has at least 256 steps.
        EXPECT_LE(max_component(error), max_component(color) * (0.5f / 256) * 1.001f);
    }
}

TEST(Rgb9e5, ClampsWhatItCannotHold) {
    const float not_a_number = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5({-1, not_a_number, 0})), Rgb(0));
    EXPECT_EQ(unpack_rgb9e5(pack_rgb9e5(Rgb(1e30f))), Rgb(65408));
}

}  // namespace
}  // namespace chiaro
