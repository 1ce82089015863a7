// Rays and bicubic patches: what is met lies on the true surface, to the tolerance, and leaves it.
#include "rays/casting.h"
#include "scene/curved_shapes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

Scene one_object(Mesh mesh, const Mat4& to_world = Mat4(1)) {
    Scene scene;
    tiny::add_material(scene, Rgb(0.5f));
    tiny::add_object(scene, std::move(mesh), to_world);
    return scene;
}

// A sphere of radius 2 made of patches is met, from inside and from outside, within 1/4000 of its
// box's diagonal; (u, v) tell the place to within what the tolerance allows.
TEST(CurvedRays, MeetTheSurface) {
    const Scene scene = one_object(curved_sphere(2));
    const RayCaster caster(scene, 1);
    const float tolerance = kCurveTolerance * 4 * std::sqrt(3.0f);
    Rng rng(1);
    for (int k = 0; k < 2000; ++k) {
        const Vec3 d = tiny::random_direction(rng);
        const bool inside = k % 2 == 0;
        const Ray ray = {inside ? Vec3(0) : -5.0f * d, d};
        const Hit hit = tiny::cast(caster, ray);
        ASSERT_TRUE(hit) << k;
        const Vec3 met = ray.origin + hit.t * d;
        EXPECT_NEAR(glm::length(met), 2, tolerance);
        const Vec3 true_place = surface_position(scene, hit.point);
        EXPECT_NEAR(glm::length(true_place), 2, 1e-5f);
        EXPECT_LT(glm::distance(true_place, met), 4 * tolerance)
            << hit.point.u << " " << hit.point.v;
        EXPECT_EQ(hit.front, !inside);
        const Vec3 normal = shading_normal(scene, hit.point, hit.normal);
        EXPECT_GT(glm::dot(normal, glm::normalize(true_place)), 0.9999f);
    }
}

// A closed surface lets no ray out, whichever way its patches are divided for the eye: 200,000 rays
// from inside of a sphere to where patches of two and of many segments meet.
TEST(CurvedRays, NoneSlipsThrough) {
    const Scene scene = one_object(curved_sphere(2));
    RayCaster caster(scene, 1, 0.02f);
    const float coarse = caster.curve_tolerance(MeshId{0});
    const auto finer_below = [&](const Box& box) {
        return box.centre().y < 0 ? 1e-3f * coarse : coarse;
    };
    for (const bool shown : {false, true}) {
        if (shown)
            caster.show_curves(
                {{ObjectId{0}, tessellate(scene.meshes[0].bicubics, finer_below, 1)}});
        Rng rng(9);
        std::vector<Ray> rays(100'000);
        for (Ray& ray : rays) {
            const SurfacePoint edge = {ObjectId{0}, rng.below(8), rng.uniform(),
                                       static_cast<float>(rng.below(2))};
            const Vec3 to = surface_position(scene, edge) + 0.05f * tiny::random_direction(rng);
            const Vec3 from = rng.uniform() * tiny::random_direction(rng);
            ray = {from, glm::normalize(to - from)};
        }
        std::vector<Hit> hits(rays.size());
        caster.intersect(rays, hits, RayKind::camera);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_TRUE(hits[i]) << i;
            EXPECT_FALSE(hits[i].front);
        }
    }
}

// What the eye is shown changes nothing for other rays, to the bit.
TEST(CurvedRays, WhatIsShownChangesNoLight) {
    const Scene scene = one_object(curved_sphere(2));
    RayCaster caster(scene, 1);
    const std::vector<Ray> rays = tiny::random_rays(2000, Vec3(0.5f, 0.2f, 0));
    std::vector<Hit> before(rays.size()), after(rays.size()), seen(rays.size());
    caster.intersect(rays, before);
    const float fine = 0.05f * caster.curve_tolerance(MeshId{0});
    caster.show_curves(
        {{ObjectId{0}, tessellate(
                           scene.meshes[0].bicubics, [&](const Box&) { return fine; }, 1)}});
    caster.intersect(rays, after);
    caster.intersect(rays, seen, RayKind::camera);
    float worst = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(before[i].t, after[i].t);
        EXPECT_EQ(before[i].point.u, after[i].point.u);
        const Vec3 met = rays[i].origin + seen[i].t * rays[i].direction;
        worst = std::max(worst, std::abs(glm::length(met) - 2));
    }
    EXPECT_LT(worst, fine);
}

// An object that is moved takes with it what the eye was shown of it.
TEST(CurvedRays, WhatIsShownMovesWithItsObject) {
    Scene scene = one_object(curved_sphere(1));
    RayCaster caster(scene, 1);
    const float fine = 0.1f * caster.curve_tolerance(MeshId{0});
    caster.show_curves(
        {{ObjectId{0}, tessellate(
                           scene.meshes[0].bicubics, [&](const Box&) { return fine; }, 1)}});
    scene.objects[0].to_world[3] = Vec4(5, 0, 0, 1);
    caster.set_transform(ObjectId{0});
    for (const RayKind kind : {RayKind::camera, RayKind::transport}) {
        const Hit hit = tiny::cast(caster, {{5, 0, 4}, {0, 0, -1}}, kind);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit.t, 3, 1e-3f);
        EXPECT_FALSE(tiny::cast(caster, {{0, 0, 4}, {0, 0, -1}}, kind));
    }
}

// A pane of patches that stops half of the light does so once, also where the ray meets an edge
// between the cells that it is divided into.
TEST(CurvedRays, SeamsOfCellsCountOnce) {
    Scene scene = one_object(curved_sphere(1));
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].alpha = 0.5f;
    const RayCaster caster(scene, 1);
    Rng rng(4);
    for (int k = 0; k < 2000; ++k) {
        // Rows and columns of cells lie at dyadic (u, v).
        const SurfacePoint seam = {ObjectId{0}, rng.below(8), static_cast<float>(rng.below(8)) / 8,
                                   rng.uniform()};
        const Vec3 p = surface_position(scene, seam);
        const Ray ray = {Vec3(0), glm::normalize(p)};
        Rgb through;
        caster.transmittance({&ray, 1}, {&through, 1});
        EXPECT_NEAR(through.r, 0.5f, 1e-6f) << seam.u << " " << seam.v;
    }
}

}  // namespace
}  // namespace chiaro
