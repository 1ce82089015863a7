// Light on bicubic patches, and from them: what closed forms say, whatever the shape is made of.
#include "sample_renderer/meter.h"
#include "scene/curved_shapes.h"
#include "scene/shapes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using tiny::Meter;
using tiny::Truth;

// Around the origin, its front outside.
Scene hollow_sphere(float radius, Rgb reflectance, Rgb emission = Rgb(0)) {
    Scene scene;
    const MaterialId m = tiny::add_material(scene, reflectance, emission);
    Mesh mesh;
    add(mesh, curved_sphere(radius), m);
    tiny::add_object(scene, std::move(mesh));
    if (max_component(emission) > 0) scene.materials[0].emits_backward = true;
    return scene;
}

// An integrating sphere of 2 m, rho 0.7, 10 000 lm at its centre: indirect
// E = rho Phi / ((1 - rho) 4 pi R^2) = 464.202 lux at any of its points, poles and seams among
// them. Standard error 0.25 %.
TEST(CurvedIntegratingSphere, IndirectLight) {
    Scene scene = hollow_sphere(2, Rgb(0.7f));
    scene.lights.push_back(tiny::point_light(Vec3(0), Rgb(10'000 / (4 * kPi))));
    for (const Truth by : tiny::kTruths) {
        const Meter meter(scene, by);
        for (const SurfacePoint where :
             {SurfacePoint{ObjectId{0}, 0, 0.3f, 0.6f}, SurfacePoint{ObjectId{0}, 3, 0.5f, 0.9999f},
              SurfacePoint{ObjectId{0}, 6, 0, 0.5f}}) {
            const ShadeRequest request = {.where = where,
                                          .front = false,
                                          .light = Light::indirect,
                                          .seed = 1,
                                          .samples = meter.worth(1 << 17)};
            ShadeResult result;
            tiny::shade(*meter.single, {&request, 1}, {&result, 1});
            EXPECT_NEAR(luminance(result.mean) / 464.202, 1, within(by, 0.015))
                << int(by) << " " << where.primitive;
        }
    }
}

// A closed furnace of patches, Le = 1 and rho another in each channel: E = pi / (1 - rho)
// everywhere, of which pi is direct. Patches are light sources, sampled as such. Mean of 100 places
// within 0.5 % (standard errors below 0.1 %), each within 3 and 6 %.
TEST(CurvedFurnace, IsFlat) {
    const Meter meter(hollow_sphere(2, {0.5f, 0.8f, 0.8f}, Rgb(1)));
    std::vector<ShadeRequest> requests;
    Rng rng(3);
    for (int i = 0; i < 100; ++i)
        requests.push_back({.where = {ObjectId{0}, rng.below(8), rng.uniform(), rng.uniform()},
                            .front = false,
                            .light = Light::total,
                            .seed = rng.next(),
                            .samples = 512,
                            .indirect_samples = 4096});
    std::vector<ShadeResult> results(requests.size());
    meter.single->shade(requests, results);
    glm::dvec3 mean(0);
    for (const ShadeResult& r : results) {
        mean += glm::dvec3(r.mean) / double(results.size());
        EXPECT_NEAR(r.mean.r / kPi, 2, 0.06);
        EXPECT_NEAR(r.mean.g / kPi, 5, 0.3);
    }
    EXPECT_NEAR(mean.r / kPi, 2, 0.01);
    EXPECT_NEAR(mean.g / kPi, 5, 0.025);
}

// A ball of radius r and radiance L at distance d from a floor's point, straight above: E = pi L
// (r / d)^2, whatever half of its patches faces away. Standard error 0.05 %.
TEST(CurvedLamp, LightsAFloorAsASphereDoes) {
    Scene scene;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(100));
    Mesh mesh;
    add(mesh, curved_sphere(0.5f), lamp);
    Mat4 mirrored(1);
    mirrored[0].x = -1;
    for (const Mat4& turn : {Mat4(1), mirrored}) {
        Scene lit = scene;
        tiny::add_object(lit, mesh, moved({0, 0, 2}) * turn);
        const Meter meter(std::move(lit));
        const float lux = meter.lux(Vec3(0), {0, 0, 1}, Light::direct, 1 << 17);
        EXPECT_NEAR(lux / (kPi * 100 / 16), 1, 0.0025);
    }
}

// Where the sun grazes a ball, light goes from full to none as the cosine does: no facet shows, and
// no point that faces the sun lies in the shadow of its own triangles. Exact to rounding.
TEST(CurvedTerminator, FollowsTheCosine) {
    Scene scene = hollow_sphere(1, Rgb(0.5f));
    scene.lights.push_back(tiny::sun({-1, 0, 0}, Rgb(1000)));
    const Meter meter(std::move(scene));
    Rng rng(5);
    for (int i = 0; i < 2000; ++i) {
        const SurfacePoint where = {ObjectId{0}, rng.below(8), rng.uniform(), rng.uniform()};
        const Vec3 n = glm::normalize(surface_position(meter.scene, where));
        const ShadeRequest request = {
            .where = where, .light = Light::direct, .seed = 1, .samples = 16};
        ShadeResult result;
        meter.single->shade({&request, 1}, {&result, 1});
        EXPECT_NEAR(luminance(result.mean), 1000 * std::max(0.0f, n.x), 0.5f) << n.x;
    }
}

}  // namespace
}  // namespace chiaro
