// Profiles through points, and what becomes of them when they are turned and moved.

#include "scene/curved_shapes.h"
#include "scene/shapes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

Vec2 end_of(const CubicCurve& curve, int k) {
    return Vec2(curve[k]) / curve[k].w;
}
Vec2 leaving(const CubicCurve& curve) {
    return glm::normalize(end_of(curve, 1) - end_of(curve, 0));
}
Vec2 arriving(const CubicCurve& curve) {
    return glm::normalize(end_of(curve, 3) - end_of(curve, 2));
}

TEST(SmoothProfile, GoesThroughItsPointsWithoutABendButAtEdges) {
    const Vec2 points[] = {{0, 0}, {0.5f, 0.2f}, {0.6f, 0.6f}, {0.6f, 0.6f}, {0.4f, 0.6f}};
    const std::vector<CubicCurve> curves = smooth_profile(points);
    ASSERT_EQ(curves.size(), 3u);
    EXPECT_EQ(end_of(curves[0], 0), points[0]);
    EXPECT_EQ(end_of(curves[0], 3), points[1]);
    EXPECT_EQ(end_of(curves[1], 3), points[2]);
    EXPECT_EQ(end_of(curves[2], 3), points[4]);
    EXPECT_NEAR(glm::distance(arriving(curves[0]), leaving(curves[1])), 0, 1e-5f);
    EXPECT_EQ(leaving(curves[0]), Vec2(1, 0));  // level on the axis
    EXPECT_NEAR(glm::distance(leaving(curves[2]), Vec2(-1, 0)), 0, 1e-5f);
}

// Rounding in a pole that was moved does not make edges of it that would have to be divided.
TEST(CurvedSphere, IsOfEightPatchesWhereverItIsMoved) {
    for (const Vec3 place : {Vec3(0.045f, 0.074f, 0.028f), Vec3(5.3f, 0.1f, -7.7f)}) {
        Mesh mesh;
        add(mesh, curved_sphere(0.042f), MaterialId{0}, moved(place));
        EXPECT_EQ(mesh.bicubics.size(), 8u) << place.x;
    }
}

}  // namespace
}  // namespace chiaro
