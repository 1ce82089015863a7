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

}  // namespace
}  // namespace chiaro
