#include "scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-6f) {
    EXPECT_NEAR(glm::length(a - b), 0, tolerance)
        << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

// 90 degrees high, twice as wide: the plane at distance 1 reaches from -1 to 1 and from -2 to 2.
const Camera kAlongMinusZ = {.eye = {1, 2, 3}, .target = {1, 2, -7}, .vertical_fov = 90};

TEST(View, TheCentreOfThePictureIsTheTarget) {
    const Ray ray = View(kAlongMinusZ, 800, 400).ray(400, 200);
    EXPECT_EQ(ray.origin, kAlongMinusZ.eye);
    expect_near(ray.direction, {0, 0, -1});
}

TEST(View, CornersAreWhereTheFieldOfViewSays) {
    const View view(kAlongMinusZ, 800, 400);
    expect_near(view.ray(0, 0).direction, glm::normalize(Vec3(-2, 1, -1)));
    expect_near(view.ray(800, 0).direction, glm::normalize(Vec3(2, 1, -1)));
    expect_near(view.ray(0, 400).direction, glm::normalize(Vec3(-2, -1, -1)));
    expect_near(view.ray(800, 400).direction, glm::normalize(Vec3(2, -1, -1)));
}

TEST(View, PixelsAreSquareAndDirectionsUnit) {
    const View view({.eye = {0, 0, 0}, .target = {1, 2, 3}, .vertical_fov = 40}, 640, 480);
    for (const Vec2 p : {Vec2(0, 0), Vec2(100.5f, 33.5f), Vec2(639.5f, 479.5f)})
        EXPECT_NEAR(glm::length(view.ray(p.x, p.y).direction), 1, 1e-6f);
    const Vec3 centre = view.ray(320, 240).direction;
    EXPECT_NEAR(glm::dot(centre, view.ray(330, 240).direction),
                glm::dot(centre, view.ray(320, 250).direction), 1e-6f);
}

TEST(View, UpNeedNotBePerpendicularAndAGazeAlongItStillWorks) {
    const View tilted({.eye = {0, 0, 0}, .target = {0, -1, -1}, .vertical_fov = 60}, 100, 100);
    EXPECT_NEAR(tilted.ray(0, 50).direction.y, tilted.ray(100, 50).direction.y, 1e-6f);  // level
    EXPECT_GT(tilted.ray(50, 0).direction.y, tilted.ray(50, 100).direction.y);

    const View down({.eye = {0, 5, 0}, .target = {0, 0, 0}, .vertical_fov = 60}, 100, 100);
    expect_near(down.ray(50, 50).direction, {0, -1, 0});
    EXPECT_TRUE(is_finite(down.ray(0, 0).direction));
}

TEST(FrameFromInside, StandsInTheRoomNearACornerAndLooksAtItsCentre) {
    const Box room = {.low = {0, 0, 0}, .high = {6, 3, 4}};
    const Camera camera = frame_from_inside(room, {0, 1, 0});
    EXPECT_NEAR(camera.eye.y, 0.55f * 3, 1e-5f);
    EXPECT_EQ(camera.target, room.centre());
    EXPECT_EQ(camera.vertical_fov, 60);
    const float from_x = std::min(camera.eye.x, 6 - camera.eye.x);
    const float from_z = std::min(camera.eye.z, 4 - camera.eye.z);
    EXPECT_GT(from_x, 0);
    EXPECT_LT(from_x, 0.15f * 6);
    EXPECT_GT(from_z, 0);
    EXPECT_LT(from_z, 0.15f * 4);
}

TEST(FrameFromInside, HonoursUp) {
    const Box room = {.low = {-1, -2, 10}, .high = {5, 2, 13}};
    const Camera camera = frame_from_inside(room, {0, 0, 2});
    EXPECT_NEAR(camera.eye.z, 10 + 0.55f * 3, 1e-5f);
    EXPECT_EQ(camera.up, Vec3(0, 0, 2));
    const Camera hanging = frame_from_inside(room, {0, 0, -1});
    EXPECT_NEAR(hanging.eye.z, 13 - 0.55f * 3, 1e-5f);
}

TEST(FrameFromInside, SeesAFloorFromAboveAndSurvivesEmptiness) {
    const Camera above = frame_from_inside({.low = {0, 0, 0}, .high = {4, 0, 4}}, {0, 1, 0});
    EXPECT_GT(above.eye.y, 1);
    const Camera nothing = frame_from_inside(Box(), {0, 1, 0});
    EXPECT_TRUE(is_finite(nothing.eye) && is_finite(nothing.target));
    EXPECT_NE(nothing.eye, nothing.target);
    const Camera point = frame_from_inside({.low = Vec3(1), .high = Vec3(1)}, {0, 1, 0});
    EXPECT_NE(point.eye, point.target);
}

}  // namespace
}  // namespace chiaro
