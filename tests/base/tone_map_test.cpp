#include "base/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

TEST(ToneMap, CurvesRiseFromZeroAndStayBelowOne) {
    float previous_s = -1;
    float previous_c = -1;
    for (const float x : {0.0f, 1e-3f, 1e-2f, 0.1f, 1.0f, 10.0f}) {
        EXPECT_GT(tumblin_s_curve(x), previous_s);
        EXPECT_GT(comparison_curve(x), previous_c);
        previous_s = tumblin_s_curve(x);
        previous_c = comparison_curve(x);
    }
    EXPECT_EQ(tumblin_s_curve(0), 0);
    EXPECT_EQ(comparison_curve(0), 0);
    EXPECT_LT(previous_s, 1);
    EXPECT_LE(comparison_curve(100), 1);
}

TEST(ToneMap, SlopeIsTheDerivativeOfTheCurve) {
    for (const float x : {0.1f, 0.4f, 1.0f, 2.0f}) {
        const float step = 1e-3f;
        const float difference =
            (comparison_curve(x + step) - comparison_curve(x - step)) / (2 * step);
        EXPECT_NEAR(comparison_slope(x), difference, 2e-3f * difference);
    }
}

// 5/16 + 9/16 + 2/16 = 1: a grey is the curve itself, and green counts most.
TEST(ToneMap, PaperWeightsSumToOne) {
    EXPECT_NEAR(paper_tone_value(Rgb(0.3f), 1), tumblin_s_curve(0.3f), 1e-6f);
    EXPECT_NEAR(paper_tone_value({0, 1, 0}, 1), 9 / 16.f * tumblin_s_curve(1), 1e-6f);
    EXPECT_NEAR(paper_tone_value(Rgb(0.1f), 3), tumblin_s_curve(0.3f), 1e-6f);
}

TEST(ToneMap, ComparisonExposureTakesTheMedianLuminanceToTwoFifths) {
    Image image(5, 1);
    for (int x = 0; x < 5; ++x) image.at(x, 0) = Rgb(static_cast<float>(x));  // one black pixel
    const float k = comparison_exposure(image);
    EXPECT_GE(0.4f / k, 2.0f);  // between the two middle luminances of 1 2 3 4
    EXPECT_LE(0.4f / k, 3.0f);
    EXPECT_EQ(comparison_exposure(Image(2, 2)), 1.0f);
}

TEST(ToneMap, PicturesForTheScreenAreWithinZeroAndOne) {
    Image image(4, 1);
    image.at(1, 0) = Rgb(0.2f);
    image.at(2, 0) = {1e6f, 0, 0};
    image.at(3, 0) = Rgb(1e9f);
    const Image shown = tone_mapped(image, 1);
    for (const Rgb& pixel : shown.pixels)
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(pixel[c], 0);
            EXPECT_LE(pixel[c], 1);
        }
    EXPECT_EQ(shown.at(0, 0), Rgb(0));
    EXPECT_GT(shown.at(1, 0).r, 0.1f);
}

// More exposure is never darker, however much it is.
TEST(ToneMap, AnyExposureBrightens) {
    Image image(3, 1);
    image.at(0, 0) = Rgb(0.5f, 0.2f, 0);
    image.at(1, 0) = Rgb(2, 0, 0);
    float previous[2] = {};
    for (const float stops : {0.0f, 2.0f, 10.0f, 30.0f, 68.0f, 100.0f, 127.0f, 130.0f, 1000.0f}) {
        const Image shown = tone_mapped(image, std::exp2(stops));
        for (int x = 0; x < 2; ++x) {
            EXPECT_GE(shown.at(x, 0).r, previous[x]) << stops;
            previous[x] = shown.at(x, 0).r;
        }
        EXPECT_EQ(shown.at(2, 0), Rgb(0)) << stops;
    }
    EXPECT_FLOAT_EQ(previous[0], 1);
    EXPECT_FLOAT_EQ(previous[1], 1);
}

// An even picture has its median at two fifths. Where a fifth of the picture is a thousand times as
// bright, its ninth tenth goes no further than 6 over white; black stays as it is.
TEST(ToneMap, AutomaticExposureSparesTheBrightTenth) {
    Image image(100, 1);
    for (Rgb& pixel : image.pixels) pixel = Rgb(2);
    EXPECT_FLOAT_EQ(automatic_exposure(image), 0.2f);
    for (int x = 0; x < 20; ++x) image.at(x, 0) = Rgb(2000);
    EXPECT_FLOAT_EQ(automatic_exposure(image), 6 / 2000.f);
    for (int x = 5; x < 20; ++x) image.at(x, 0) = Rgb(2);  // less than a tenth may go over
    EXPECT_FLOAT_EQ(automatic_exposure(image), 0.2f);
    EXPECT_EQ(automatic_exposure(Image(3, 3)), 1);
}

}  // namespace
}  // namespace chiaro
