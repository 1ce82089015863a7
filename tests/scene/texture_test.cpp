#include "scene/texture.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// Four greys in a row, linear: 0, 1/3, 2/3, 1.
Texture ramp() {
    Texture t;
    t.width = 4;
    t.height = 1;
    t.srgb = false;
    t.texels = {{0, 0, 0, 255}, {85, 85, 85, 255}, {170, 170, 170, 255}, {255, 255, 255, 255}};
    return t;
}

TEST(Texture, BilinearBetweenTexelCentres) {
    const Texture t = ramp();
    EXPECT_NEAR(sample_texture(t, {0.375f, 0.5f}).r, 1 / 3.0f, 1e-6f);
    EXPECT_NEAR(sample_texture(t, {0.5f, 0.5f}).r, 0.5f, 1e-6f);
}

TEST(Texture, NearestTakesTheTexel) {
    Texture t = ramp();
    t.nearest = true;
    EXPECT_NEAR(sample_texture(t, {0.49f, 0.5f}).r, 1 / 3.0f, 1e-6f);
    EXPECT_NEAR(sample_texture(t, {0.51f, 0.5f}).r, 2 / 3.0f, 1e-6f);
    EXPECT_NEAR(sample_texture(t, {-1e-9f, 0.5f}).r, 1, 1e-6f);  // wraps to just below 1
}

// At u = 0 the neighbours are the last and the first texel, the first twice, or mirrored alike.
TEST(Texture, WrapModes) {
    Texture t = ramp();
    EXPECT_NEAR(sample_texture(t, {0, 0.5f}).r, 0.5f, 1e-6f);
    EXPECT_NEAR(sample_texture(t, {7.5f, 0.5f}).r, 0.5f, 1e-5f);
    t.wrap_u = Wrap::clamp_to_edge;
    EXPECT_NEAR(sample_texture(t, {-5, 0.5f}).r, 0, 1e-6f);
    EXPECT_NEAR(sample_texture(t, {5, 0.5f}).r, 1, 1e-6f);
    t.wrap_u = Wrap::mirrored_repeat;
    EXPECT_NEAR(sample_texture(t, {1.375f, 0.5f}).r, 2 / 3.0f, 1e-5f);
    EXPECT_NEAR(sample_texture(t, {-0.375f, 0.5f}).r, 1 / 3.0f, 1e-5f);
}

// Colour channels are decoded before they are blended; alpha never is.
TEST(Texture, SrgbIsDecodedAlphaIsNot) {
    Texture t = ramp();
    t.srgb = true;
    for (auto& texel : t.texels) texel[3] = 128;
    EXPECT_NEAR(sample_texture(t, {0.375f, 0.5f}).r, srgb_to_linear(85 / 255.0f), 1e-6f);
    EXPECT_NEAR(sample_texture(t, {0.375f, 0.5f}).a, 128 / 255.0f, 1e-6f);
}

TEST(Texture, AnyCoordinateIsSafe) {
    Texture t = ramp();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
        t.wrap_u = t.wrap_v = wrap;
        for (const float x :
             {nan, kInfinity, -kInfinity, 3e38f, -3e38f, 1e20f, -1e-30f, 0.9999999f}) {
            const float value = sample_texture(t, {x, -x}).r;
            EXPECT_GE(value, 0);
            EXPECT_LE(value, 1);
        }
    }
    EXPECT_EQ(sample_texture(t, {nan, 0}).r, 0);
}

// KHR_texture_transform: scale first, then turn, then move; a quarter turn takes +u to -v, which is
// up in the image.
TEST(Texture, TransformOrder) {
    TextureUse use;
    use.scale = {2, 3};
    use.rotation = kPi / 2;
    use.offset = {10, 20};
    const Vec2 moved = use.transform({1, 1});
    EXPECT_NEAR(moved.x, 10 + 3, 1e-5f);
    EXPECT_NEAR(moved.y, 20 - 2, 1e-5f);
}

TEST(Texture, MeanIsWeightedByAlpha) {
    Texture t = ramp();
    EXPECT_NEAR(mean_color(t).r, 0.5f, 1e-6f);
    for (auto& texel : t.texels) texel[3] = texel[0];
    EXPECT_NEAR(mean_color(t).r, (1 / 9.0f + 4 / 9.0f + 1) / 2, 1e-5f);
    for (auto& texel : t.texels) texel[3] = 0;
    EXPECT_NEAR(mean_color(t).r, 0.5f, 1e-6f);
}

}  // namespace
}  // namespace chiaro
