// What holds of every scene: where one looks from does not change the light, what gets no light is
// black, and memory is bounded without a loss.
#include "base/tone_map.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/reference_renderer.h"
#include "update/studio.h"

namespace chiaro {
namespace {

using tiny::down_on;
using tiny::fixed_size;
using tiny::SquareView;
using tiny::Studio;

Scene cube() {
    Scene scene;
    tiny::add_room(scene, Vec3(-2), Vec3(2), tiny::add_material(scene, Rgb(0.5f)));
    scene.lights.push_back(tiny::point_light(Vec3(0), Rgb(10'000 / (4 * kPi))));
    return scene;
}
const SquareView kFloor = down_on(Vec3(0), 2, 80, 20);
const SquareView kWall = {Vec3(0), {1, 0, 0}, {0, 0, 1}, 2, 80, 20};

// Root mean square of the relative difference of two pictures' luminances.
double relative_difference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = luminance(a.pixels[i]) / double(luminance(b.pixels[i])) - 1;
        sum += d * d;
    }
    return std::sqrt(sum / double(a.pixels.size()));
}

// A camera path does not change irradiance: diffuse shading is kept, so that on return nothing is
// shaded again and the picture, once it is antialiased as the one before, is what it was. Vertices
// shared with the walls have been refined meanwhile: 0.5 % is theirs.
TEST(CameraPath, KeepsDiffuseShading) {
    for (const Scheme scheme : {Scheme::best, Scheme::paper}) {
        Studio studio(cube(), fixed_size(scheme));
        const int cycles = scheme == Scheme::best ? 30 : 10;
        studio.cycle.look_from(kFloor.view());
        studio.run(cycles);
        const Image before = studio.cycle.picture();

        studio.cycle.look_from(kWall.view());
        studio.run(cycles);
        studio.cycle.look_from(kFloor.view());
        const std::size_t points = studio.points();
        studio.run(2);
        EXPECT_EQ(studio.points(), points) << "shaded again";
        EXPECT_LT(relative_difference(studio.cycle.picture(), before), 0.005);
    }
}

// The same wall seen from two places, on the way to and fro, has the same illuminance.
TEST(CameraPath, IrradianceDoesNotDependOnTheEye) {
    Studio studio(cube(), fixed_size(Scheme::best));
    studio.cycle.look_from(kFloor.view());
    studio.run(40);
    const Image from_the_centre = studio.cycle.picture();
    // Half as far, twice as wide: the same points in the same pixels.
    const SquareView near = down_on({0, 0, -1}, 1, 80, 20);
    studio.cycle.look_from(near.view());
    studio.run(2);
    EXPECT_LT(relative_difference(studio.cycle.picture(), from_the_centre), 0.005);
}

// A plate hides a point light from a black floor: the umbra is 2 x 2 m, half of that in the plate's
// plane. Nothing lights it, so it is 0, not small; outside, the inverse square law holds.
TEST(Shadows, UnlitPartsAreBlack) {
    Scene scene;
    const MaterialId black = tiny::add_material(scene, Rgb(0));
    tiny::add_quad(scene, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, black);
    tiny::add_quad(scene, {-0.5f, -0.5f, 1.5f}, {1, 0, 0}, {0, 1, 0}, black);
    scene.lights.push_back(tiny::point_light({0, 0, 3}, Rgb(1000)));
    const SquareView view = down_on({0, 0, 1}, 1, 81, 20);
    for (const Scheme scheme : {Scheme::best, Scheme::paper}) {
        Studio studio(scene, fixed_size(scheme));
        studio.cycle.look_from(view.view());
        studio.run(scheme == Scheme::best ? 60 : 200);
        const Image picture = studio.cycle.picture();
        // The penumbra of a point has no width: 4 pixels (20 cm) are left to interpolation.
        int leaks = 0;
        for (int y = 25; y <= 55; ++y)
            for (int x = 25; x <= 55; ++x) leaks += luminance(picture.at(x, y)) > 0 ? 1 : 0;
        EXPECT_EQ(leaks, 0) << "of " << 31 * 31 << ", scheme "
                            << (scheme == Scheme::best ? "best" : "paper");
        for (const double x : {1.3, 1.6, 1.9}) {
            const double lux = 1000 * 3 / std::pow(9 + x * x, 1.5);
            EXPECT_NEAR(luminance(view.at(picture, x, 0)) / lux, 1, 0.01) << x;
            EXPECT_NEAR(luminance(view.at(picture, 0, -x)) / lux, 1, 0.01) << x;
        }
    }
}

// A side that no light reaches stays black however long it is refined: the space behind a wall.
TEST(Shadows, BehindAWallIsBlack) {
    Scene scene;
    tiny::add_quad(scene, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, tiny::add_material(scene, Rgb(0.8f)));
    scene.lights.push_back(tiny::point_light({0, 2, 0}, Rgb(1000)));
    Studio studio(std::move(scene), fixed_size(Scheme::best, Aov::radiance));
    studio.cycle.look_from(SquareView({0, -2, 0}, {0, 1, 0}, {0, 0, 1}, 2, 40, 15).view());
    studio.run(10);
    for (const Rgb& p : studio.cycle.picture().pixels) EXPECT_EQ(p, Rgb(0));
}

// Light that is hard to find is found: a lamp behind a partition lights the other half of a room by
// a gap of 30 cm alone. There most first samples find nothing, and a cache that believed them, or
// only the lucky ones, would be far too dark or too bright for ever. Blocks of the picture against
// a reference of the same light: the middle one right to 10 %, two of three not brighter than 35 %
// too much and none darker. (Some stay up to 3.6 times too bright: docs/overview.md, known
// failures.)
TEST(Shadows, LightThroughAGapIsFound) {
    Scene scene;
    const MaterialId grey = tiny::add_material(scene, Rgb(0.5f));
    tiny::add_room(scene, {0, 0, 0}, {8, 4, 3}, grey);
    tiny::add_quad(scene, {4, 0, 0}, {0, 3.7f, 0}, {0, 0, 3}, grey);
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(1000));
    tiny::add_quad(scene, {6.8f, 1, 2.9f}, {0, 0.4f, 0}, {0.4f, 0, 0}, lamp);
    const SquareView view = down_on({2, 2, 2.9f}, 2.9f, 65, 16);

    Studio studio(scene, fixed_size(Scheme::best));
    ReferenceRenderer reference(make_lit_scene(studio.scene, studio.rays, studio.area_lights),
                                view.view(), {7, 2});
    reference.add_pass(1024);
    const Image truth = reference.image();
    studio.cycle.look_from(view.view());
    studio.run(200);
    const Image picture = studio.cycle.picture();

    constexpr int kBlock = 13;
    std::vector<double> ratios;
    for (int by = 0; by + kBlock <= 65; by += kBlock)
        for (int bx = 0; bx + kBlock <= 65; bx += kBlock) {
            double ours = 0, right = 0;
            for (int y = by; y < by + kBlock; ++y)
                for (int x = bx; x < bx + kBlock; ++x) {
                    ours += luminance(picture.at(x, y));
                    right += luminance(truth.at(x, y)) * kPi / 0.5;
                }
            ratios.push_back(ours / right);
        }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_NEAR(ratios[ratios.size() / 2], 1, 0.10);
    EXPECT_GT(ratios[ratios.size() / 20], 1 / 1.35);
    EXPECT_LT(ratios[ratios.size() * 2 / 3], 1.35);
}

// Aging (3.1): a cache that holds what one view needs, and half as much again, goes round six walls
// and back. It stays within its budget, but for what the view needs, and nothing is lost for good.
TEST(Aging, MemoryIsBoundedAndThePictureIsRight) {
    std::size_t one_view = 0;
    Image alone;
    {
        Studio studio(cube(), fixed_size(Scheme::best));
        studio.cycle.look_from(kFloor.view());
        studio.run(30);
        one_view = studio.cycle.cache().bytes();
        alone = studio.cycle.picture();
    }
    UpdateSettings settings = fixed_size(Scheme::best);
    settings.aging.budget_bytes = one_view + one_view / 2;
    settings.aging.unseen_cycles = 3;
    Studio studio(cube(), settings);
    const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::size_t most = 0;
    for (const Vec3 axis : axes) {
        const Vec3 up = std::abs(axis.z) > 0 ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
        studio.cycle.look_from(SquareView(Vec3(0), axis, up, 2, 80, 20).view());
        for (int i = 0; i < 30; ++i) {
            studio.cycle.run();
            most = std::max(most, studio.cycle.cache().bytes());
        }
    }
    // Children go only once unseen for 3 cycles: the new view's first picture may stand beside the
    // old one's.
    EXPECT_LT(double(most), 1.25 * double(settings.aging.budget_bytes));
    EXPECT_LT(relative_difference(studio.cycle.picture(), alone), 0.01);
}

}  // namespace
}  // namespace chiaro
