// A closed room that shines with Le = 1 everywhere: every pixel shows L = 1 / (1 - rho), whatever
// the room's shape. A cap on bounces, a leak or a mixed-up channel would show.
#include "sample_renderer/whites.h"
#include "update/studio.h"

namespace chiaro {
namespace {

using tiny::fixed_size;
using tiny::Studio;

constexpr Rgb kRho(0.5f, 0.8f, 0.95f);
constexpr Rgb kExpected(2, 5, 20);

Camera in_the_corner() {
    Camera camera;
    camera.eye = {-1.8f, -1.5f, -1.6f};
    camera.target = {1, 1.2f, 0.8f};
    camera.up = {0, 0, 1};
    camera.vertical_fov = 75;
    return camera;
}

Image furnace(Scheme scheme, bool furnished, int cycles) {
    Scene scene;
    const MaterialId shining = tiny::add_material(scene, kRho, Rgb(1));
    tiny::add_room(scene, Vec3(-2), {2, 2, 1}, shining);
    if (furnished) tiny::add_box(scene, {0, 0, -2}, {0.8f, 1, -0.5f}, shining);
    Studio studio(std::move(scene), fixed_size(scheme, Aov::radiance));
    studio.cycle.look_from({in_the_corner(), 64, 48});
    studio.run(cycles);
    return studio.cycle.picture();
}

// `deviation`: bound on the standard deviation of a pixel, which is noise and nothing else; no
// pixel is further off than 6 of them.
void expect_furnace(const Image& picture, double deviation) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(tiny::mean_of(picture)[c] / kExpected[c], 1, 0.01) << "channel " << c;
        double worst = 0, squares = 0;
        for (const Rgb& p : picture.pixels) {
            const double error = double(p[c]) / kExpected[c] - 1;
            worst = std::max(worst, std::abs(error));
            squares += error * error;
        }
        EXPECT_LT(std::sqrt(squares / double(picture.pixels.size())), deviation) << "channel " << c;
        EXPECT_LT(worst, 6 * deviation) << "channel " << c;
    }
}

TEST(Furnace, EmptyRoom) {
    expect_furnace(furnace(Scheme::best, false, 20), 0.04);
}
TEST(Furnace, RoomWithABox) {
    expect_furnace(furnace(Scheme::best, true, 20), 0.04);
}
TEST(Furnace, EmptyRoomByThePaper) {
    expect_furnace(furnace(Scheme::paper, false, 6), 0.08);
}

// What absorbs nothing cannot be seen in a closed room of one radiance either, half of which its
// walls emit. Noise leaves no pixel more than 0.35 and the mean 0.01 off; `gather` may add its
// bias.
TEST(Furnace, WhateverAbsorbsNothingVanishesInAClosedRoom) {
    for (const tiny::White& white : tiny::kWhites)
        for (const tiny::Truth by : {tiny::Truth::path, tiny::Truth::gather}) {
            Scene scene;
            tiny::add_room(scene, Vec3(-3), Vec3(3),
                           tiny::add_material(scene, Rgb(0.5f), {0.5f, 1, 0}));
            tiny::add_white_box(scene, white);
            Studio studio(std::move(scene), fixed_size(Scheme::best, Aov::radiance), by);
            studio.cycle.look_from(
                View({.eye = {2.5f, 2.6f, 2.7f}, .target = {0, 0, 0}, .vertical_fov = 60}, 32, 24));
            studio.run(5);
            const Image picture = studio.cycle.picture();
            float worst = 0;
            for (const Rgb& p : picture.pixels) {
                worst = std::max({worst, std::abs(p.r - 1), std::abs(p.g / 2 - 1)});
                EXPECT_EQ(p.b, 0);
            }
            EXPECT_LT(worst, 0.35f) << white.name << " " << int(by);
            const double mean = tiny::mean_of(picture).r;
            EXPECT_NEAR(mean, 1, within(by, 0.01)) << white.name << " " << int(by);
        }
}

}  // namespace
}  // namespace chiaro
