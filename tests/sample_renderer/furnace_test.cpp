// Form factors and furnaces: answers that are known whatever the shape of the room. Standard errors
// over seeds are given as they were measured; bounds are at least 5 of them, false alarm 6e-7 a
// number.
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using tiny::Meter;
using tiny::Truth;

// Mean over the unit square z = 0 of E / pi, which is the form factor to what shines with L = 1.
double form_factor(const Meter& meter, int n, std::uint32_t samples) {
    double sum = 0;
    Rng rng(1);
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y) {
            const Vec3 p((float(x) + rng.uniform()) / float(n),
                         (float(y) + rng.uniform()) / float(n), 0);
            sum += luminance(meter.at(p, {0, 0, 1}, Light::direct, samples, rng.next()).mean);
        }
    return sum / (n * n) / kPi;
}

// Standard error 0.07 %.
TEST(FormFactors, OppositeUnitSquares) {
    Scene scene;
    tiny::add_quad(scene, {0, 0, 1}, {0, 1, 0}, {1, 0, 0},
                   tiny::add_material(scene, Rgb(0), Rgb(1)));
    EXPECT_NEAR(form_factor(Meter(scene), 48, 32) / 0.199824896, 1, 0.005);
}

// Standard error 0.15 %: light grazes along the common edge.
TEST(FormFactors, AdjacentUnitSquares) {
    Scene scene;
    tiny::add_quad(scene, Vec3(0), {0, 1, 0}, {0, 0, 1}, tiny::add_material(scene, Rgb(0), Rgb(1)));
    EXPECT_NEAR(form_factor(Meter(scene), 96, 64) / 0.200043776, 1, 0.01);
}

// Discs of radius 1, 1 apart, the lamp a fan of 512 triangles; points even over the other disc.
// Standard error 0.07 %.
TEST(FormFactors, CoaxialDiscs) {
    Scene scene;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1));
    Mesh mesh;
    constexpr std::uint32_t kSides = 512;
    mesh.positions.push_back({0, 0, 1});
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const float angle = 2 * kPi * float(i) / kSides;
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 1});
        mesh.primitives.push_back(tiny::triangle(0, 1 + (i + 1) % kSides, 1 + i, lamp));
    }
    tiny::add_object(scene, mesh);
    const Meter meter(scene);
    double sum = 0;
    constexpr int kPoints = 2000;
    Rng rng(2);
    for (int i = 0; i < kPoints; ++i) {
        const float r = std::sqrt((float(i) + rng.uniform()) / kPoints);
        sum += luminance(meter.at({r, 0, 0}, {0, 0, 1}, Light::direct, 64, rng.next()).mean);
    }
    EXPECT_NEAR(sum / kPoints / kPi / 0.381966011, 1, 0.004);
}

// Irradiance at a surface of such a furnace: pi L, of which pi Le is direct. Walks that are joined
// must not be long, since their cost is the square of that: rho 0.8 in blue too. Standard errors of
// `path` 0.2 % in red and green, 0.7 % in blue.
void expect_irradiance(Scene scene, Vec3 inside, Truth by) {
    double blue = 20;
    if (by == Truth::bidirectional) {
        for (Material& material : scene.materials) material.base_color.b = 0.8f;
        blue = 5;
    }
    const Meter meter(std::move(scene), by);
    const Hit hit = meter.look(inside, {0.3f, 0.2f, -1});
    const Vec3 n = hit.front ? hit.normal : -hit.normal;
    const Vec3 p = inside + hit.t * Vec3(0.3f, 0.2f, -1) + 1e-4f * n;
    const Rgb direct = meter.at(p, n, Light::direct, 1 << 12).mean;
    const Rgb indirect = meter.at(p, n, Light::indirect, meter.worth(1 << 15)).mean;
    EXPECT_NEAR(direct.r / kPi, 1, 0.01);
    const glm::dvec3 total(glm::dvec3(direct + indirect) / double(kPi));
    EXPECT_NEAR(total.r / 2, 1, within(by, 0.01)) << int(by);
    EXPECT_NEAR(total.g / 5, 1, within(by, 0.015)) << int(by);
    EXPECT_NEAR(total.b / blue, 1, within(by, 0.035)) << int(by);
}

// All faces shine with Le = 1 and reflect rho, another in each channel: L = 1 / (1 - rho), whatever
// the shape. A cap on bounces, a lost or doubled path or a leak shows at once. Standard errors are
// 0.04 % at rho 0.5, 0.08 % at 0.8 and 0.3 % at 0.95.
void expect_furnace(const Scene& scene, Vec3 inside) {
    const Meter meter(scene);
    std::vector<Ray> rays;
    Rng rng(3);
    for (int i = 0; i < 64; ++i)
        rays.push_back(
            {inside, glm::normalize(Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.5f)});
    std::vector<Rgb> values(rays.size());
    radiance(meter.lit, rays, {.seed = 4, .samples = 2048}, values);
    Rgb mean(0);
    for (const Rgb& value : values) mean += value / float(values.size());
    EXPECT_NEAR(mean.r / 2, 1, 0.005);
    EXPECT_NEAR(mean.g / 5, 1, 0.005);
    EXPECT_NEAR(mean.b / 20, 1, 0.018);
    for (const Truth by : tiny::kTruths) expect_irradiance(scene, inside, by);
}

const Rgb kRho(0.5f, 0.8f, 0.95f);

TEST(EmissiveFurnace, Box) {
    Scene scene;
    tiny::add_room(scene, {-1, -2, -3}, {4, 2, 1}, tiny::add_material(scene, kRho, Rgb(1)));
    expect_furnace(scene, {0.5f, 0, 0});
}

TEST(EmissiveFurnace, Tetrahedron) {
    Scene scene;
    const MaterialId m = tiny::add_material(scene, kRho, Rgb(1));
    Mesh mesh;
    mesh.positions = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    mesh.primitives = {tiny::triangle(0, 2, 1, m), tiny::triangle(0, 1, 3, m),
                       tiny::triangle(0, 3, 2, m), tiny::triangle(1, 2, 3, m)};
    scene.materials[0].emits_backward = true;  // whichever way these wind
    tiny::add_object(scene, mesh);
    expect_furnace(scene, Vec3(0.05f));
}

// A room with a box and a thin sheet in it: corners, contacts, two-sided emission, and a mesh that
// is bent where its quads are not flat.
TEST(EmissiveFurnace, FurnishedRoom) {
    Scene scene;
    const MaterialId m = tiny::add_material(scene, kRho, Rgb(1));
    const MaterialId sheet = tiny::add_material(scene, kRho, Rgb(1));
    scene.materials[1].emits_backward = true;
    tiny::add_room(scene, Vec3(-2), Vec3(2), m);
    tiny::add_box(scene, {-1.5f, -1.5f, -2}, {-0.2f, -0.3f, -1}, m);
    tiny::add_box(scene, {0.5f, 0.5f, -0.5f}, {1, 1, 0.5f}, m);
    Mesh bent;
    bent.positions = {{-1, 0.5f, 0}, {0, 1, 0.5f}, {0, 1.5f, 1.2f}, {-1, 1.4f, 0.4f}};
    bent.primitives = {tiny::quad(0, 1, 2, 3, sheet)};
    tiny::add_object(scene, bent);
    expect_furnace(scene, {0, 0, 1});
}

// An integrating sphere of 2 m, rho 0.7, 10 000 lm at its centre, as 96 x 48 flat faces: indirect
// E = rho Phi / ((1 - rho) 4 pi R^2) = 464.2 lux; the faces' smaller area makes 0.1 % more.
// Standard error 0.25 %.
TEST(IntegratingSphere, IndirectLight) {
    Scene scene;
    const MaterialId m = tiny::add_material(scene, Rgb(0.7f));
    Mesh mesh;
    constexpr std::uint32_t kAround = 96, kDown = 48;
    for (std::uint32_t j = 0; j <= kDown; ++j)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const float theta = kPi * float(j) / kDown, phi = 2 * kPi * float(i) / kAround;
            mesh.positions.push_back(2.0f * Vec3(std::sin(theta) * std::cos(phi),
                                                 std::sin(theta) * std::sin(phi), std::cos(theta)));
        }
    for (std::uint32_t j = 0; j < kDown; ++j)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t a = j * kAround + i, b = j * kAround + (i + 1) % kAround;
            mesh.primitives.push_back(tiny::quad(a, b, b + kAround, a + kAround, m));
        }
    tiny::add_object(scene, mesh);
    scene.lights.push_back(tiny::point_light(Vec3(0), Rgb(10'000 / (4 * kPi))));
    for (const Truth by : tiny::kTruths) {
        const Meter meter(scene, by);
        for (const Vec3 d :
             {Vec3(1, 0.2f, 0.1f), Vec3(-0.3f, 0.5f, 0.9f), Vec3(0.02f, -0.7f, -0.3f)}) {
            const Hit hit = meter.look(Vec3(0), glm::normalize(d));
            const Vec3 n = hit.front ? hit.normal : -hit.normal;
            const Vec3 p = hit.t * glm::normalize(d) + 1e-4f * n;
            const float lux = meter.lux(p, n, Light::indirect, meter.worth(1 << 17));
            EXPECT_NEAR(lux / 464.202, 1, within(by, 0.015)) << int(by);
        }
    }
}

}  // namespace
}  // namespace chiaro
