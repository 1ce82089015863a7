#include "base/color.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

TEST(Color, LuminanceOfWhiteIsOne) {
    EXPECT_FLOAT_EQ(luminance(Rgb(1)), 1.0f);
    EXPECT_FLOAT_EQ(luminance({1, 0, 0}), 0.2126f);
    EXPECT_FLOAT_EQ(luminance({0, 1, 0}), 0.7152f);
    EXPECT_FLOAT_EQ(luminance({0, 0, 1}), 0.0722f);
}

TEST(Color, MaxComponentFindsEachChannel) {
    EXPECT_EQ(max_component({3, 2, 1}), 3.0f);
    EXPECT_EQ(max_component({1, 3, 2}), 3.0f);
    EXPECT_EQ(max_component({1, 2, 3}), 3.0f);
}

// Values of IEC 61966-2-1.
TEST(Color, SrgbHasTheStandardsValues) {
    EXPECT_FLOAT_EQ(srgb_to_linear(0), 0.0f);
    EXPECT_FLOAT_EQ(srgb_to_linear(1), 1.0f);
    EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404f, 1e-5f);
    EXPECT_NEAR(linear_to_srgb(0.18f), 0.46136f, 1e-5f);
    EXPECT_NEAR(srgb_to_linear(0.04045f), 0.0031308f, 1e-6f);  // where its two pieces meet
}

TEST(Color, EverySrgbByteSurvivesTheRoundTrip) {
    for (int byte = 0; byte < 256; ++byte) {
        const float encoded = static_cast<float>(byte) / 255;
        EXPECT_NEAR(linear_to_srgb(srgb_to_linear(encoded)), encoded, 1e-5f);
    }
}

}  // namespace
}  // namespace chiaro
