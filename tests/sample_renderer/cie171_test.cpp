// CIE 171:2006, section 5: rooms whose illuminance is an integral. Expected values are the exact
// integrals, not the report's tables. Of every sampled number the standard error over seeds is
// given, as it was measured; bounds are at least 5 of them, with what else is left out: a sound
// program fails one of these with a chance of 6e-7 a number.
#include "sample_renderer/meter.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using tiny::Meter;
using tiny::Truth;

constexpr Vec3 kUp(0, 0, 1);

void expect_lux(float found, double expected, double tolerance, const char* what, double where) {
    EXPECT_NEAR(found / expected, 1, tolerance) << what << " " << where;
}

// 5.2: a Lambertian source of 1 cm, 1000 cd straight down, 3 m above a plane 4 x 4 m. Standard
// error 2e-5.
TEST(Cie171, PointSourceLambertian) {
    Scene scene;
    const float side = 0.01f;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1000 / (side * side)));
    tiny::add_quad(scene, {2 - side / 2, 2 - side / 2, 3}, {0, side, 0}, {side, 0, 0}, lamp);
    tiny::add_quad(scene, Vec3(0), {4, 0, 0}, {0, 4, 0}, tiny::add_material(scene, Rgb(0)));
    const Meter meter(scene);
    const double expected[6][3] = {{0, 0, 111.11},  {0.5, 0, 105.19}, {1, 0, 90.00},
                                   {1.5, 0, 71.11}, {1, 1, 74.38},    {1.5, 1.5, 49.38}};
    for (const auto& [x, y, lux] : expected)
        expect_lux(meter.lux({2 + x, 2 + y, 0}, kUp, Light::direct, 256), lux, 0.001, "x", x);
}

// 5.2: an isotropic source of 10 000 lm. One exact evaluation: no variance at all.
TEST(Cie171, PointSourceIsotropic) {
    Scene scene;
    scene.lights.push_back(tiny::point_light({0, 0, 3}, Rgb(10'000 / (4 * kPi))));
    tiny::add_quad(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, tiny::add_material(scene, Rgb(0)));
    const Meter meter(scene);
    const double expected[4][3] = {{0, 0, 88.42}, {1, 0, 75.49}, {1, 1, 65.44}, {1.5, 1.5, 48.13}};
    for (const auto& [x, y, lux] : expected) {
        const ShadeResult e = meter.at({x, y, 0}, kUp, Light::direct, 4);
        expect_lux(luminance(e.mean), lux, 2e-4, "x", x);
        EXPECT_EQ(e.variance, Rgb(0));
    }
}

// 5.3: a Lambertian source of 1 x 1 m in the ceiling's centre, 1000 cd/m2. Standard error 0.03 %.
TEST(Cie171, AreaSource) {
    Scene scene;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1000));
    tiny::add_room(scene, Vec3(0), {4, 4, 3.001f}, tiny::add_material(scene, Rgb(0)));
    tiny::add_quad(scene, {1.5f, 1.5f, 3}, {0, 1, 0}, {1, 0, 0}, lamp);
    const Meter meter(scene);
    const double expected[4][2] = {{0.25, 61.42}, {0.75, 79.26}, {1.25, 95.67}, {1.75, 105.78}};
    for (const auto& [y, lux] : expected)
        expect_lux(meter.lux({2, y, 0}, kUp, Light::direct, 1 << 14), lux, 0.002, "y", y);
}

// Sum over a closed black room of illuminance x area, on a grid of n x n points a face.
double flux_received(Meter& meter, Vec3 size, int n, std::uint32_t samples) {
    std::vector<ShadeRequest> requests;
    for (std::uint32_t p = 0; p < 6; ++p)
        for (int x = 0; x < n; ++x)
            for (int y = 0; y < n; ++y) {
                const SurfacePoint where = {ObjectId(0), p, (float(x) + 0.5f) / float(n),
                                            (float(y) + 0.5f) / float(n)};
                requests.push_back(
                    {.where = where, .seed = std::uint32_t(requests.size()), .samples = samples});
            }
    double flux = 0;
    const auto results = meter.shade(requests);
    for (std::size_t i = 0; i < results.size(); ++i) {
        const int p = int(requests[i].where.primitive);
        const double area = p < 2 ? size.x * size.y : p < 4 ? size.x * size.z : size.y * size.z;
        flux += luminance(results[i].mean) * area / (n * n);
    }
    return flux;
}

// 5.4: what a source sends out arrives, all of it, in a closed black room of 80 m2: from a point
// with no noise, from an area with a standard error of 0.03 %.
TEST(Cie171, FluxIsConserved) {
    const Vec3 size(4, 4, 3);
    Scene point;
    tiny::add_room(point, Vec3(0), size, tiny::add_material(point, Rgb(0)));
    point.lights.push_back(tiny::point_light({1.2f, 2.3f, 1.1f}, Rgb(10'000 / (4 * kPi))));
    Meter by_point(point);
    EXPECT_NEAR(flux_received(by_point, size, 48, 4) / 80, 125, 0.125);

    // A lamp that hangs in the room and shines both ways, pi L A each.
    Scene area;
    tiny::add_room(area, Vec3(0), size, tiny::add_material(area, Rgb(0)));
    const MaterialId lamp = tiny::add_material(area, Rgb(0), Rgb(2000));
    area.materials[1].emits_backward = true;
    tiny::add_quad(area, {1, 1.5f, 2}, {1, 0, 0.2f}, {0, 1, 0}, lamp);
    Meter by_area(area);
    const double sent = 2 * kPi * 2000 * std::sqrt(1.04);
    EXPECT_NEAR(flux_received(by_area, size, 32, 256) / sent, 1, 0.002);
}

// 5.6: a floor of rho 0.3 under parallel light E_h lights a wall. Indirect light on the wall alone,
// since the parallel light grazes it. Standard error 0.04 to 0.08 %.
TEST(Cie171, DiffuseReflection) {
    Scene scene;
    tiny::add_quad(scene, Vec3(0), {4, 0, 0}, {0, 4, 0}, tiny::add_material(scene, Rgb(0.3f)));
    scene.lights.push_back(tiny::sun({0, 0, -1}, Rgb(1000)));
    const double expected[5][2] = {
        {0.75, 35.901}, {1.25, 27.992}, {1.75, 21.639}, {2.25, 16.716}, {2.75, 12.967}};
    for (const Truth by : tiny::kTruths) {
        const Meter meter(scene, by);
        for (const auto& [z, percent] : expected)
            expect_lux(meter.lux({2, 0, z}, {0, 1, 0}, Light::indirect, meter.worth(1 << 17)),
                       percent * 3, within(by, 0.005), "z", z);
    }
}

Scene cube(float rho) {
    Scene scene;
    tiny::add_room(scene, Vec3(-2), Vec3(2), tiny::add_material(scene, Rgb(rho)));
    scene.lights.push_back(tiny::point_light(Vec3(0), Rgb(10'000 / (4 * kPi))));
    return scene;
}

// 5.8: mean indirect illuminance of a cube of 4 m with a source at its centre, all faces rho:
// Phi rho / (96 (1 - rho)). By symmetry the mean of a quarter of a face, on a grid of midpoints,
// which is 0.24 % too much at most; standard error 0.1 to 0.3 %. Where walks are long the joined
// ones are left out: their cost is the square of that.
TEST(Cie171, InterreflectionMean) {
    for (const float rho : {0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 0.95f})
        for (const Truth by : tiny::kTruths) {
            if (by == Truth::bidirectional && rho > 0.7f) continue;
            Meter meter(cube(rho), by);
            std::vector<ShadeRequest> requests;
            constexpr int kGrid = 8;
            for (int x = 0; x < kGrid; ++x)
                for (int y = 0; y < kGrid; ++y)
                    requests.push_back({.where = {ObjectId(0), 0, (float(x) + 0.5f) / (2 * kGrid),
                                                  (float(y) + 0.5f) / (2 * kGrid)},
                                        .light = Light::indirect,
                                        .seed = std::uint32_t(requests.size()),
                                        .samples = meter.worth(2048)});
            double mean = 0;
            for (const ShadeResult& result : meter.shade(requests)) mean += luminance(result.mean);
            mean /= kGrid * kGrid;
            EXPECT_NEAR(mean / (10'000 * rho / (96 * (1 - double(rho)))), 1, within(by, 0.017))
                << rho << " " << int(by);
        }
}

// 5.8, point by point at rho = 0.5, from the centre of a face. Standard error 0.25 %.
TEST(Cie171, InterreflectionPointByPoint) {
    const double expected[5][3] = {
        {0, 0, 112.04}, {1, 0, 110.88}, {1, 1, 107.78}, {1.5, 1.5, 96.85}, {1.9, 1.9, 77.03}};
    for (const Truth by : tiny::kTruths) {
        const Meter meter(cube(0.5f), by);
        for (const auto& [x, y, lux] : expected)
            expect_lux(meter.lux({x, y, -2}, kUp, Light::indirect, meter.worth(1 << 17)), lux,
                       within(by, 0.015), "x", x);
        expect_lux(meter.lux({0, 0, -2}, kUp, Light::direct, 4), 198.94, 1e-4, "direct", 0);
    }
}

}  // namespace
}  // namespace chiaro
