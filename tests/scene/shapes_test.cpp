// Volumes by the divergence theorem: right only if every face looks outward and none is missing.

#include "scene/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

Vec3 corner(const Mesh& mesh, const Primitive& primitive, int i) {
    return mesh.positions[primitive.corners[i]];
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (const Primitive& p : mesh.primitives)
        for (int i = 1; i + 1 < p.corner_count(); ++i)
            sum += glm::dot(corner(mesh, p, 0),
                            glm::cross(corner(mesh, p, i), corner(mesh, p, i + 1))) /
                   6;
    return sum;
}

// Normals at corners lean the way that the winding faces.
void expect_normals_outward(const Mesh& mesh) {
    for (const Primitive& p : mesh.primitives) {
        const int last = p.corner_count() - 1;
        const Vec3 area = glm::cross(corner(mesh, p, 1) - corner(mesh, p, 0),
                                     corner(mesh, p, last) - corner(mesh, p, 0));
        for (int i = 0; i <= last; ++i) {
            const Vec3 normal = mesh.normals[p.corners[i]];
            EXPECT_NEAR(glm::length(normal), 1, 1e-5f);
            EXPECT_GT(glm::dot(normal, glm::normalize(area)), 0.4f);
        }
    }
}

TEST(Shapes, BoxHasItsVolumeAndSixFaces) {
    const Mesh mesh = box({1, 1, 1}, {2, 3, 4});
    EXPECT_EQ(mesh.quad_count, 6u);
    EXPECT_NEAR(volume(mesh), 6, 1e-5);
    expect_normals_outward(mesh);
    EXPECT_EQ(box(Vec3(0), Vec3(1), kBottom | kLeft).quad_count, 4u);
}

TEST(Shapes, RoundedBoxIsALittleSmallerThanItsBox) {
    const Mesh mesh = rounded_box({-1, -1, -1}, {1, 1, 1}, 0.25f);
    EXPECT_EQ(mesh.quad_count, 54u);
    // Inner box, six slabs, twelve quarter rods and a ball's eight octants, all of them cut by
    // facets.
    const double ideal = 3.375 + 6 * 2.25 * 0.25 + 12 * 1.5 * kPi * 0.0625 / 4 + 4 * kPi / 3 / 64;
    EXPECT_LT(volume(mesh), ideal);
    EXPECT_GT(volume(mesh), 0.97 * ideal);
    expect_normals_outward(mesh);
}

TEST(Shapes, LatheOfAClosedProfileIsAPrism) {
    const Vec2 profile[] = {{0, 0}, {1, 0}, {1, 0}, {1, 2}, {1, 2}, {0, 2}};
    const Mesh mesh = lathe(profile, 12);
    EXPECT_NEAR(volume(mesh), 2 * 12 * 0.5 * std::sin(2 * kPi / 12), 1e-5);
    EXPECT_EQ(mesh.quad_count, 12u);
    EXPECT_EQ(mesh.primitives.size(), 36u);  // the discs are triangles
    expect_normals_outward(mesh);
}

TEST(Shapes, BarAndLoftFaceOutward) {
    Mesh mesh = bar({0, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0.2f, 0.4f});
    EXPECT_EQ(mesh.quad_count, 4u);
    // Without caps, which would add a third about the middle of its axis.
    Mesh centred;
    add(centred, mesh, MaterialId{0}, moved({0, -1, 0}));
    EXPECT_NEAR(volume(centred), 2 * 0.2 * 0.4 * 2 / 3, 1e-6);
    expect_normals_outward(centred);
}

TEST(Shapes, MouldingRunsRoundInside) {
    // A flat frame of width 1 round 4 x 3: its area is 12 - 2.
    const Vec2 profile[] = {{0, 0.5f}, {1, 0.5f}};
    const Mesh mesh = moulding({4, 3}, profile);
    ASSERT_EQ(mesh.quad_count, 4u);
    double area = 0;
    for (const Primitive& p : mesh.primitives) {
        const Vec3 a = glm::cross(corner(mesh, p, 2) - corner(mesh, p, 0),
                                  corner(mesh, p, 3) - corner(mesh, p, 1));
        EXPECT_GT(a.z, 0);
        area += 0.5 * glm::length(a);
    }
    EXPECT_NEAR(area, 10, 1e-5);
}

TEST(Shapes, SheetFacesDuCrossDv) {
    const Mesh mesh = sheet(3, 2, [](float u, float v) { return Vec3(u, v, 0); });
    EXPECT_EQ(mesh.quad_count, 6u);
    expect_normals_outward(mesh);
    for (const Vec3 n : mesh.normals) EXPECT_NEAR(n.z, 1, 1e-4f);
}

}  // namespace
}  // namespace chiaro
