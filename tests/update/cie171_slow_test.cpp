// CIE 171:2006, section 5, through the Shading Cache: illuminance read off the picture's pixels,
// which is interpolated between vertices. Expected values are the exact integrals.
#include "update/studio.h"

namespace chiaro {
namespace {

using tiny::down_on;
using tiny::fixed_size;
using tiny::SquareView;
using tiny::Studio;

struct Expected {
    double x, y, lux;
};

void expect_points(const SquareView& view, const Image& picture, std::span<const Expected> points,
                   double tolerance) {
    for (const auto& [x, y, lux] : points)
        EXPECT_NEAR(luminance(view.at(picture, x, y)) / lux, 1, tolerance) << x << ", " << y;
}

// 5.2: a point 3 m above the centre of a plane 4 x 4 m; the eye hangs below it.
constexpr Vec3 kBelowTheLamp(0, 0, 2.5f);

Scene floor_alone() {
    Scene scene;
    tiny::add_quad(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, tiny::add_material(scene, Rgb(0)));
    return scene;
}

class PointSource : public testing::TestWithParam<Scheme> {};

// An isotropic source of 10 000 lm: E = (Phi / 4 pi) h / (h^2 + r^2)^1.5.
TEST_P(PointSource, Isotropic) {
    Scene scene = floor_alone();
    scene.lights.push_back(tiny::point_light({0, 0, 3}, Rgb(10'000 / (4 * kPi))));
    const SquareView view = down_on(kBelowTheLamp, 2.5f, 81, 20);
    Studio studio(std::move(scene), fixed_size(GetParam()));
    studio.cycle.look_from(view.view());
    studio.run(GetParam() == Scheme::best ? 8 : 24);
    const Expected expected[] = {{0, 0, 88.42}, {1, 0, 75.49}, {1, 1, 65.44}, {1.5, 1.5, 48.13}};
    expect_points(view, studio.cycle.picture(), expected, 0.01);
}

// A Lambertian source of 1 cm, 1000 cd straight down: E = I0 h^2 / (h^2 + r^2)^2.
TEST_P(PointSource, Lambertian) {
    Scene scene = floor_alone();
    const float side = 0.01f;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1000 / (side * side)));
    tiny::add_quad(scene, {-side / 2, -side / 2, 3}, {0, side, 0}, {side, 0, 0}, lamp);
    const SquareView view = down_on(kBelowTheLamp, 2.5f, 81, 20);
    Studio studio(std::move(scene), fixed_size(GetParam()));
    studio.cycle.look_from(view.view());
    studio.run(GetParam() == Scheme::best ? 8 : 24);
    const Expected expected[] = {{0, 0, 111.11},  {0.5, 0, 105.19}, {1, 0, 90.00},
                                 {1.5, 0, 71.11}, {1, 1, 74.38},    {1.5, 1.5, 49.38}};
    expect_points(view, studio.cycle.picture(), expected, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Cie171, PointSource, testing::Values(Scheme::best, Scheme::paper),
                         tiny::scheme_name);

// 5.3: a Lambertian source of 1 x 1 m in the ceiling's centre, 1000 cd/m2.
TEST(Cie171, AreaSource) {
    Scene scene;
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1000));
    tiny::add_room(scene, {-2, -2, 0}, {2, 2, 3.001f}, tiny::add_material(scene, Rgb(0)));
    tiny::add_quad(scene, {-0.5f, -0.5f, 3}, {0, 1, 0}, {1, 0, 0}, lamp);
    const SquareView view = down_on(kBelowTheLamp, 2.5f, 81, 20);
    Studio studio(std::move(scene), fixed_size(Scheme::best));
    studio.cycle.look_from(view.view());
    studio.run(40);
    const Expected expected[] = {
        {0, 1.75, 61.42}, {0, -1.25, 79.26}, {0, 0.75, 95.67}, {0, -0.25, 105.78}};
    expect_points(view, studio.cycle.picture(), expected, 0.01);
}

// 5.8: a cube of 4 m, all faces rho, an isotropic source of 10 000 lm at its centre, where the eye
// is too. Light on the floor: direct by the inverse square, indirect by the exact integrals.
double direct_in_cube(double x, double y) {
    return 10'000 / (4 * double(kPi)) * 2 / std::pow(4 + x * x + y * y, 1.5);
}

Scene cube(float rho) {
    Scene scene;
    tiny::add_room(scene, Vec3(-2), Vec3(2), tiny::add_material(scene, Rgb(rho)));
    scene.lights.push_back(tiny::point_light(Vec3(0), Rgb(10'000 / (4 * kPi))));
    return scene;
}

class Interreflection : public testing::TestWithParam<Scheme> {};

TEST_P(Interreflection, PointByPoint) {
    UpdateSettings settings = fixed_size(GetParam());
    settings.indirect_samples = 1600;  // the paper's 400 leave 2 % of noise at a single point
    Studio studio(cube(0.5f), settings);
    const SquareView view = down_on(Vec3(0), 2, 81, 20);
    studio.cycle.look_from(view.view());
    studio.run(GetParam() == Scheme::best ? 100 : 24);
    Expected expected[] = {
        {0, 0, 112.04}, {1, 0, 110.88}, {1, 1, 107.78}, {1.5, 1.5, 96.85}, {1.9, 1.9, 77.03}};
    for (auto& [x, y, lux] : expected) lux += direct_in_cube(x, y);
    expect_points(view, studio.cycle.picture(), expected, 0.02);
}

// The mean over a face: Phi rho / (96 (1 - rho)) indirect, and a sixth of the flux over 16 m2
// direct.
TEST_P(Interreflection, Mean) {
    for (const float rho : {0.5f, 0.8f}) {
        Studio studio(cube(rho), fixed_size(GetParam()));
        const SquareView view = down_on(Vec3(0), 2, 80, 20);  // the face, and nothing else
        studio.cycle.look_from(view.view());
        studio.run(GetParam() == Scheme::best ? 40 : 12);
        const double expected = 10'000 * rho / (96 * (1 - double(rho))) + 10'000.0 / 96;
        EXPECT_NEAR(luminance(tiny::mean_of(studio.cycle.picture())) / expected, 1, 0.01) << rho;
    }
}

// By rays that end in cells: within 2 % too, up to rho = 0.9, where errors of cells would add up if
// cells were filled from each other; they are filled by traced paths.
TEST(Cie171, InterreflectionGathered) {
    for (const float rho : {0.5f, 0.8f, 0.9f}) {
        Studio studio(cube(rho), fixed_size(Scheme::best), tiny::Truth::gather);
        const SquareView view = down_on(Vec3(0), 2, 80, 20);
        studio.cycle.look_from(view.view());
        studio.run(40);
        const double expected = 10'000 * rho / (96 * (1 - double(rho))) + 10'000.0 / 96;
        EXPECT_NEAR(luminance(tiny::mean_of(studio.cycle.picture())) / expected, 1, 0.02) << rho;
    }
}

INSTANTIATE_TEST_SUITE_P(Cie171, Interreflection, testing::Values(Scheme::best, Scheme::paper),
                         tiny::scheme_name);

}  // namespace
}  // namespace chiaro
