#include "scene/environment.h"

#include "base/random.h"
#include "scene/scene.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// A map whose pixels all differ.
Image numbered(int width, int height) {
    Image map(width, height);
    for (int i = 0; i < width * height; ++i)
        map.pixels[i] = Rgb(1 + float(i), 2, 1 / (1 + float(i)));
    return map;
}

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-6f) {
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

// Where +y is up the middle is +x, the right quarter +z and the sides -x, as viewers of glTF have
// it; where +z is up +x, -y and -x, as in Blender. The top is up.
TEST(Environment, TheMiddleOfAMapIsAlongXAndItsRightIsToTheRight) {
    const EnvironmentFrame y_up({0, 2, 0}), z_up({0, 0, 1});
    expect_near(y_up.direction_of({0.5f, 0.5f}), {1, 0, 0});
    expect_near(y_up.direction_of({0.75f, 0.5f}), {0, 0, 1});
    expect_near(y_up.direction_of({0, 0.5f}), {-1, 0, 0});
    expect_near(y_up.direction_of({1, 0.5f}), {-1, 0, 0});
    expect_near(y_up.direction_of({0.3f, 0}), {0, 1, 0});
    expect_near(y_up.direction_of({0.3f, 1}), {0, -1, 0});
    expect_near(z_up.direction_of({0.5f, 0.5f}), {1, 0, 0});
    expect_near(z_up.direction_of({0.75f, 0.5f}), {0, -1, 0});
    expect_near(z_up.direction_of({0.3f, 0}), {0, 0, 1});
}

// A camera that looks at the middle sees what is to the right of it in the map on its right.
TEST(Environment, AMapIsNotMirrored) {
    for (const Vec3 up : {Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.3f, -1, 0.5f), Vec3(1, 0, 0)}) {
        const EnvironmentFrame frame(up);
        const Camera camera = {
            .eye = Vec3(0), .target = frame.direction_of({0.5f, 0.5f}), .up = up};
        const Vec3 seen = View(camera, 400, 300).ray(300, 100).direction;
        const Vec2 place = frame.place_of(seen);
        EXPECT_GT(place.x, 0.51f);
        EXPECT_LT(place.x, 0.75f);
        EXPECT_LT(place.y, 0.49f);  // and above it
    }
}

TEST(Environment, APlaceInAMapIsThatOfItsDirection) {
    Rng rng(3);
    for (int i = 0; i < 2000; ++i) {
        const EnvironmentFrame frame(
            {rng.uniform() - 0.5f, rng.uniform() - 0.5f, rng.uniform() - 0.5f});
        const Vec2 place(rng.uniform(), 0.01f + 0.98f * rng.uniform());
        const Vec2 again = frame.place_of(7.0f * frame.direction_of(place));
        EXPECT_NEAR(again.x, place.x, 1e-5f);
        EXPECT_NEAR(again.y, place.y, 1e-5f);
    }
}

TEST(Environment, AMapIsBilinearRoundAndRoundAndEvenAtThePoles) {
    const Environment e = {.map = numbered(4, 2)};
    const EnvironmentFrame frame({0, 1, 0});
    const auto red = [&](float u, float v) {
        return radiance_from(e, frame, frame.direction_of({u, v})).r;
    };
    EXPECT_NEAR(red(0.375f, 0.25f), 2, 1e-5f);  // the centre of pixel (1, 0)
    EXPECT_NEAR(red(0.375f, 0.75f), 6, 1e-5f);
    EXPECT_NEAR(red(0.5f, 0.25f), 2.5f, 1e-5f);
    EXPECT_NEAR(red(0.5f, 0.5f), 4.5f, 1e-5f);
    EXPECT_NEAR(red(0.001f, 0.25f), 2.5f - 3 * 0.004f, 1e-3f);  // half of 1 and of 4
    EXPECT_NEAR(red(0.999f, 0.25f), 2.5f + 3 * 0.004f, 1e-3f);
    EXPECT_NEAR(red(0.375f, 0.01f), 2, 1e-5f);
    EXPECT_NEAR(red(0.375f, 0.99f), 6, 1e-5f);
}

TEST(Environment, WithoutAMapItIsTheSameEverywhere) {
    const Environment e = {.sky = {1, 2, 3}};
    EXPECT_EQ(radiance_from(e, EnvironmentFrame({0, 1, 0}), {3, -2, 1}), Rgb(1, 2, 3));
}

TEST(Environment, IsLightUnlessItIsBlack) {
    Scene scene;
    EXPECT_TRUE(is_dark(scene.environment));
    EXPECT_FALSE(has_light(scene));
    scene.environment.sky = {0, 0, 1};
    EXPECT_TRUE(has_light(scene));
    scene.environment.map = Image(3, 2);  // black, and takes the place of the sky
    EXPECT_FALSE(has_light(scene));
    scene.environment.map.at(2, 1).b = 1e-20f;
    EXPECT_TRUE(has_light(scene));
    check_scene(scene);
}

TEST(EnvironmentDeathTest, AFaultyOneIsNoScene) {
    Scene scene;
    scene.environment.sky.g = -1;
    EXPECT_DEATH(check_scene(scene), "sky");
    scene.environment = {.map = Image(2, 2)};
    scene.environment.map.at(1, 1).g = kInfinity;
    EXPECT_DEATH(check_scene(scene), "not finite");
    scene.environment.map = Image(2, 2);
    scene.environment.map.width = 3;
    EXPECT_DEATH(check_scene(scene), "size");
}

}  // namespace
}  // namespace chiaro
