// Rational bicubic patches: what they are, and what meshes make of them.
#include "scene/bicubic.h"

#include "base/error.h"
#include "base/random.h"
#include "scene/bicubic_mesh.h"
#include "scene/curved_shapes.h"
#include "scene/tessellate.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

namespace chiaro {
namespace {

Vec3 random_place(Rng& rng) {
    return {rng.uniform(), rng.uniform(), rng.uniform()};
}

// A bumpy sheet of about unit size over the x-y plane, with weights.
BicubicPatch random_sheet(Rng& rng) {
    BicubicPatch patch;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            const float w = 0.5f + rng.uniform();
            const Vec3 p = Vec3(i, j, 0) / 3.0f + 0.2f * random_place(rng);
            patch.at(i, j) = Vec4(w * p, w);
        }
    return patch;
}

// Tangents are what finite differences of the position tend to.
TEST(Bicubic, TangentsAreDerivatives) {
    Rng rng(1);
    for (int k = 0; k < 100; ++k) {
        const BicubicPatch patch = random_sheet(rng);
        const Vec2 uv = 0.1f + 0.8f * Vec2(rng.uniform(), rng.uniform());
        constexpr float kStep = 2e-3f;
        const PatchPoint p = patch_point(patch, uv);
        const Vec3 du = (patch_position(patch, uv + Vec2(kStep, 0)) -
                         patch_position(patch, uv - Vec2(kStep, 0))) /
                        (2 * kStep);
        const Vec3 dv = (patch_position(patch, uv + Vec2(0, kStep)) -
                         patch_position(patch, uv - Vec2(0, kStep))) /
                        (2 * kStep);
        EXPECT_LT(glm::distance(p.du, du), 1e-3f);
        EXPECT_LT(glm::distance(p.dv, dv), 1e-3f);
        EXPECT_LT(glm::distance(p.position, patch_position(patch, uv)), 1e-6f);
    }
}

// The halves are the same surface, at half the step in u or in v.
TEST(Bicubic, HalvesAreTheSameSurface) {
    Rng rng(2);
    for (int k = 0; k < 100; ++k) {
        const BicubicPatch patch = random_sheet(rng);
        const Vec2 uv(rng.uniform(), rng.uniform());
        const Vec2 low = 0.5f * uv;
        EXPECT_LT(glm::distance(patch_position(halves_in_u(patch)[0], uv),
                                patch_position(patch, {low.x, uv.y})),
                  1e-6f);
        EXPECT_LT(glm::distance(patch_position(halves_in_v(patch)[1], uv),
                                patch_position(patch, {uv.x, 0.5f + low.y})),
                  1e-6f);
    }
}

// Spheres of rational patches are spheres: all places at the radius, all normals along it, poles
// and seams included.
TEST(Bicubic, SpheresAreExact) {
    const Mesh mesh = curved_sphere(3);
    ASSERT_EQ(mesh.bicubics.size(), 8u);
    Rng rng(3);
    for (int k = 0; k < 2000; ++k) {
        const BicubicPatch& patch = mesh.bicubics[rng.below(8)];
        Vec2 uv(rng.uniform(), rng.uniform());
        if (k % 4 == 0) uv.y = static_cast<float>(rng.below(2));
        if (k % 5 == 0) uv.x = static_cast<float>(rng.below(2));
        const Vec3 p = patch_position(patch, uv);
        EXPECT_NEAR(glm::length(p), 3, 2e-6f);
        EXPECT_GT(glm::dot(patch_normal(patch, uv), p / 3.0f), 0.99999f) << uv.x << " " << uv.y;
    }
}

// Two petals between the same two poles have edges that nothing tells apart: each is divided
// across. What is in order stays as it is.
TEST(Bicubic, EdgesAreKnownByTheirEnds) {
    const Mesh sphere = curved_sphere(1);
    Mesh petals;
    for (int k = 0; k < 2; ++k) {
        const float bulge = k == 0 ? 1.0f : -1.0f;
        std::array<Vec3, 16> points;
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const float t = static_cast<float>(j) / 3, s = static_cast<float>(i) / 3 - 0.5f;
                points[4 * j + i] = {4 * t * (1 - t) * s, t, bulge * 4 * t * (1 - t) * 0.3f};
            }
        // Poles of both in the same two places; the sides bulge apart.
        for (int i = 0; i < 4; ++i) {
            points[i] = Vec3(0);
            points[12 + i] = {0, 1, 0};
        }
        add_bicubic(petals, make_bicubic(points), MaterialId{0});
    }
    EXPECT_EQ(order_primitives(petals), 0u);
    EXPECT_EQ(petals.bicubics.size(), 4u);
    EXPECT_EQ(petals.quad_count, 4u);

    Mesh again = sphere;
    EXPECT_EQ(order_primitives(again), 0u);
    EXPECT_EQ(again.bicubics.size(), 8u);
    EXPECT_EQ(again.positions.size(), sphere.positions.size());
}

// Far from the origin, and thin as a thread, tangents and normals are still those of the shape: a
// sphere of 3 cm at 1000 m, whose points are rounded to 0.06 mm, and a strip of 10 m by 0.1 mm.
TEST(Bicubic, NormalsHoldFarAwayAndOnStrips) {
    const BicubicPatch octant = curved_sphere(0.03f).bicubics[1];
    Mat4 far(1);
    far[3] = Vec4(1000, 0, 0, 1);
    const BicubicPatch there = transformed(octant, far);
    Rng rng(6);
    for (int k = 0; k < 200; ++k) {
        const Vec2 uv(rng.uniform(), 0.9f * rng.uniform());
        EXPECT_GT(glm::dot(patch_normal(there, uv), patch_normal(octant, uv)), 0.9998f);
    }
    std::array<Vec3, 16> points;
    for (int k = 0; k < 16; ++k)
        points[k] = {10 * static_cast<float>(k % 4) / 3, 1e-4f * static_cast<float>(k / 4) / 3, 0};
    EXPECT_EQ(patch_normal(make_bicubic(points), Vec2(0.5f)), Vec3(0, 0, 1));
    std::swap(points[0], points[12]);  // mirrored, corner by corner
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) points[4 * j + i].y = 1e-4f * static_cast<float>(3 - j) / 3;
    for (int k = 0; k < 16; ++k) points[k].x = 10 * static_cast<float>(k % 4) / 3;
    EXPECT_EQ(patch_normal(make_bicubic(points), Vec2(0.5f)), Vec3(0, 0, -1));
}

// A surface whose derivative vanishes on a line through its middle is a surface for all that: u
// runs as 0, 1, 0, 1 there and back.
TEST(Bicubic, ACuspInTheMiddleIsNoLackOfArea) {
    std::array<Vec3, 16> points;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            points[4 * j + i] = {static_cast<float>(i % 2), static_cast<float>(j) / 3, 0};
    Mesh mesh;
    add_bicubic(mesh, make_bicubic(points), MaterialId{0});
    EXPECT_EQ(order_primitives(mesh), 0u);
    EXPECT_EQ(std::abs(patch_normal(mesh.bicubics[0], Vec2(0.5f)).z), 1);
}

// Patches without area say nothing and are dropped.
TEST(Bicubic, PatchesWithoutAreaAreDropped) {
    Mesh mesh;
    std::array<Vec3, 16> points;
    for (int k = 0; k < 16; ++k) points[k] = Vec3(static_cast<float>(k), 0, 0);
    add_bicubic(mesh, make_bicubic(points), MaterialId{0});
    EXPECT_EQ(order_primitives(mesh), 1u);
    EXPECT_TRUE(mesh.primitives.empty());
}

float distance_to_triangle_plane(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 n = glm::cross(b - a, c - a);
    return std::abs(glm::dot(p - a, n)) / std::max(glm::length(n), 1e-20f);
}

// The middle of every triangle and of its edges is as near to the surface as was asked: at the same
// (u, v), a bound on the distance.
TEST(Tessellate, IsWithinTheTolerance) {
    Rng rng(4);
    for (const float tolerance : {1e-2f, 1e-3f, 1e-4f})
        for (int k = 0; k < 10; ++k) {
            const BicubicPatch patch = random_sheet(rng);
            const PatchGrids grids = tessellate(
                {&patch, 1}, [&](const Box&) { return tolerance; }, 1);
            const PatchGrid& grid = grids.grids[0];
            const auto at = [&](int i, int j) {
                return grids.points[static_cast<std::size_t>(j * (grid.columns + 1) + i)];
            };
            const auto surface = [&](float i, float j) {
                return patch_position(patch, {i / grid.columns, j / grid.rows});
            };
            float worst = 0;
            for (int j = 0; j < grid.rows; ++j)
                for (int i = 0; i < grid.columns; ++i) {
                    const auto x = static_cast<float>(i), y = static_cast<float>(j);
                    worst =
                        std::max({worst,
                                  distance_to_triangle_plane(surface(x + 1 / 3.0f, y + 1 / 3.0f),
                                                             at(i, j), at(i + 1, j), at(i, j + 1)),
                                  distance_to_triangle_plane(surface(x + 0.5f, y + 0.5f), at(i, j),
                                                             at(i + 1, j), at(i, j + 1))});
                }
            EXPECT_LT(worst, tolerance);
        }
}

// What is flat, or as good as flat, is two triangles, however far away its rounding makes it
// uneven; what takes too many points is refused before memory is.
TEST(Tessellate, TakesNoMoreThanItNeeds) {
    std::array<Vec3, 16> points;
    for (int k = 0; k < 16; ++k)
        points[k] = Vec3(1e4f + static_cast<float>(k % 4) / 3, static_cast<float>(k / 4) / 3, 1e4f);
    const BicubicPatch flat = make_bicubic(points);
    const ToleranceIn tolerance = [](const Box&) { return 1.5f / 4000; };
    EXPECT_LE(tessellate({&flat, 1}, tolerance, 1).triangles(), 8u);

    const std::vector<BicubicPatch> many(3000, curved_sphere(1).bicubics[0]);
    const ToleranceIn tiny = [](const Box&) { return 1e-9f; };
    EXPECT_GT(grid_points(many, tiny, 2), kMostGridPoints);
    EXPECT_THROW(tessellate(many, tiny, 2), Error);
}

// Edges of a closed surface whose patches are divided differently are the same polylines, to the
// bit: every point of a coarse side is one of the fine side's.
TEST(Tessellate, NeighboursAgreeOnTheirEdges) {
    const Mesh mesh = curved_sphere(1);
    // Finer to the left.
    const PatchGrids grids = tessellate(
        mesh.bicubics, [](const Box& box) { return box.centre().x < 0 ? 1e-5f : 1e-2f; }, 2);
    using Place = std::tuple<float, float, float>;
    std::map<Place, int> corners;  // on edges, by how many patches have them
    for (std::size_t k = 0; k < grids.grids.size(); ++k) {
        const PatchGrid& grid = grids.grids[k];
        std::map<Place, int> own;
        for (int j = 0; j <= grid.rows; ++j)
            for (int i = 0; i <= grid.columns; ++i) {
                if (i > 0 && i < grid.columns && j > 0 && j < grid.rows) continue;
                const Vec3 p = grids.points[grid.first +
                                            static_cast<std::uint32_t>(j * (grid.columns + 1) + i)];
                // On the sphere: a corner of the edge's polyline, not a point of its chords.
                if (std::abs(glm::length(p) - 1) < 1e-6f) own[{p.x, p.y, p.z}] = 1;
            }
        for (const auto& [place, one] : own) corners[place] += one;
    }
    std::size_t fine = 0;
    for (const auto& [place, patches] : corners) {
        EXPECT_GE(patches, 2);
        fine += patches == 2;
    }
    EXPECT_GT(fine, 100u);
    EXPECT_NE(grids.grids[0].columns, grids.grids[4].columns);
}

}  // namespace
}  // namespace chiaro
