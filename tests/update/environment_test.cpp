// Pictures under the sky, through the cache.
#include "update/studio.h"

namespace chiaro {
namespace {

using tiny::Studio;
using tiny::Truth;

// What absorbs nothing cannot be seen in an even sky: a picture of two white boxes is even, by
// every renderer. Noise leaves no pixel more than 0.06 and the mean 0.01 off.
TEST(Environment, WhiteBoxesVanishInAnEvenSky) {
    for (const Truth by : tiny::kTruths) {
        Scene scene;
        scene.environment.sky = {1, 2, 0};
        const MaterialId white = tiny::add_material(scene, Rgb(1));
        tiny::add_box(scene, Vec3(-1), Vec3(1), white);
        tiny::add_box(scene, {-1, 1.5f, -1}, {0, 2, 1}, white);
        Studio studio(std::move(scene), tiny::fixed_size(Scheme::best, Aov::radiance), by);
        studio.cycle.look_from(View({.eye = {3, 4, 5}, .target = {0, 0.5f, 0}}, 48, 36));
        studio.run(20);
        const Image picture = studio.cycle.picture();
        float worst = 0;
        for (const Rgb& p : picture.pixels) {
            worst = std::max({worst, std::abs(p.r - 1), std::abs(p.g / 2 - 1)});
            EXPECT_EQ(p.b, 0);
        }
        EXPECT_LT(worst, 0.06f);
        EXPECT_NEAR(tiny::mean_of(picture).r, 1, 0.01);
    }
}

// A floor under the sky: pi L of irradiance where nothing is in the way, and none where there is no
// surface.
TEST(Environment, AFloorUnderAnEvenSkyReceivesPi) {
    Scene scene;
    scene.environment.sky = Rgb(100);
    tiny::add_quad(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, tiny::add_material(scene, Rgb(0.5f)));
    Studio studio(std::move(scene), tiny::fixed_size(Scheme::best));
    const tiny::SquareView down = tiny::down_on({0, 0, 3}, 3, 31, 10);
    studio.cycle.look_from(down.view());
    studio.run(4);
    const Image picture = studio.cycle.picture();
    EXPECT_NEAR(down.at(picture, 0, 0).g / (100 * kPi), 1, 0.003);
    EXPECT_NEAR(down.at(picture, 0.8, -0.5).g / (100 * kPi), 1, 0.003);
    EXPECT_EQ(down.at(picture, 1.3, 0).g, 0);
}

}  // namespace
}  // namespace chiaro
