// The error of a picture against hand-computed values.
#include "base/image_difference.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

Image grey(std::initializer_list<float> values) {
    Image image(static_cast<int>(values.size()), 1);
    int x = 0;
    for (const float v : values) image.at(x++, 0) = Rgb(v);
    return image;
}
double shown(double x) {
    return std::pow(1 - std::exp(-x), 1 / 2.2);
}

// b = 1, 2, 4 has the median 2, so k = 0.2. Against a = 2, 2, 3 the scaled differences are 0.2, 0,
// -0.2.
TEST(ImageDifference, EqualsHandComputedValues) {
    const ImageDifference d = difference(grey({2, 2, 3}), grey({1, 2, 4}));
    EXPECT_NEAR(d.k, 0.2, 1e-6);
    EXPECT_NEAR(d.rmse, std::sqrt((0.04 + 0 + 0.04) / 3), 1e-6);
    EXPECT_NEAR(d.relmse, (0.04 / (0.04 + 0.01) + 0 + 0.04 / (0.64 + 0.01)) / 3, 1e-6);
    const double low = shown(0.4) - shown(0.2), high = shown(0.6) - shown(0.8);
    EXPECT_NEAR(d.psnr, -10 * std::log10((low * low + high * high) / 3), 1e-4);
}

// Colour channels count alike: an error in one of three is a third of one in all.
TEST(ImageDifference, MeansOverColourChannels) {
    Image a = grey({1, 1});
    const Image b = a;
    a.at(0, 0) = {1.5f, 1, 1};
    const ImageDifference one = difference(a, b);
    a.at(0, 0) = Rgb(1.5f);
    const ImageDifference all = difference(a, b);
    EXPECT_NEAR(all.rmse * all.rmse, 3 * one.rmse * one.rmse, 1e-9);
    EXPECT_NEAR(all.relmse, 3 * one.relmse, 1e-9);
    EXPECT_NEAR(all.psnr, one.psnr - 10 * std::log10(3), 1e-6);
}

TEST(ImageDifference, EqualPicturesDoNotDiffer) {
    const ImageDifference d = difference(grey({1, 0, 7}), grey({1, 0, 7}));
    EXPECT_EQ(d.rmse, 0);
    EXPECT_EQ(d.relmse, 0);
    EXPECT_TRUE(std::isinf(d.psnr) && d.psnr > 0);
}

// Scaled pictures compare alike: k takes the units out.
TEST(ImageDifference, DoesNotDependOnUnits) {
    const ImageDifference d = difference(grey({2, 2, 3}), grey({1, 2, 4}));
    const ImageDifference scaled = difference(grey({200, 200, 300}), grey({100, 200, 400}));
    EXPECT_NEAR(scaled.k, d.k / 100, 1e-9);
    EXPECT_NEAR(scaled.rmse, d.rmse, 1e-6);
    EXPECT_NEAR(scaled.relmse, d.relmse, 1e-6);
    EXPECT_NEAR(scaled.psnr, d.psnr, 1e-4);
}

// Two halves r + n and r + m of independent noise of deviation s: the product of the differences
// has the mean (a - r)^2, where the square against their mean would have s^2 / 2 more. With 30,000
// terms of deviation about s^2 the mean is known to s^2 / 173; bound 6 of these, false alarm 2e-9.
TEST(ImageDifference, TheNoiseOfTheHalvesCancels) {
    Rng rng(1);
    constexpr float kSpread = 0.1f, kError = 0.02f;
    Image a(100, 100), half_1(100, 100), half_2(100, 100), mean(100, 100);
    const auto noise = [&] { return kSpread * std::sqrt(3.0f) * (2 * rng.uniform() - 1); };
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        a.pixels[i] = Rgb(1 + kError);
        half_1.pixels[i] = Rgb(1 + noise(), 1 + noise(), 1 + noise());
        half_2.pixels[i] = Rgb(1 + noise(), 1 + noise(), 1 + noise());
        mean.pixels[i] = 0.5f * (half_1.pixels[i] + half_2.pixels[i]);
    }
    const ImageDifference crossed = difference(a, half_1, half_2);
    const ImageDifference plain = difference(a, mean);
    const double k2 = crossed.k * crossed.k, s2 = kSpread * kSpread, e2 = kError * kError;
    EXPECT_NEAR(crossed.rmse * crossed.rmse / k2, e2, 6 * s2 / 173);
    EXPECT_NEAR(plain.rmse * plain.rmse / k2, e2 + s2 / 2, 6 * s2 / 173);
    // The weights of relMSE hold noise too: there it cancels but to the first order.
    EXPECT_LT(crossed.relmse, 0.3 * plain.relmse);
    EXPECT_GT(crossed.psnr, plain.psnr + 5);
}

// A sum that noise makes negative is an error of zero.
TEST(ImageDifference, NegativeSumsCountAsZero) {
    const ImageDifference d = difference(grey({2, 2}), grey({1, 1}), grey({3, 3}));
    EXPECT_EQ(d.rmse, 0);
    EXPECT_EQ(d.relmse, 0);
    EXPECT_TRUE(std::isinf(d.psnr));
}

TEST(ImageDifference, RefusesWhatCannotBeCompared) {
    EXPECT_THROW(difference(grey({1, 2}), grey({1})), Error);
    EXPECT_THROW(difference(grey({1}), grey({1}), grey({1, 2})), Error);
    EXPECT_THROW(difference(grey({NAN}), grey({1})), Error);
    EXPECT_THROW(difference(grey({1}), grey({INFINITY})), Error);
}

}  // namespace
}  // namespace chiaro
