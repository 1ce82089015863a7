// The environment behind all else.
#include "image_generator/looking.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

// A map in which every direction differs: radiance is 2 + the direction, in the frame's axes.
Environment colored(int width) {
    Environment environment = {.map = Image(width, width / 2)};
    const EnvironmentFrame frame({0, 1, 0});
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x)
            environment.map.at(x, y) =
                2.0f + frame.direction_of(Vec2(float(x) + 0.5f, float(y) + 0.5f) /
                                          Vec2(float(width), float(width) / 2));
    return environment;
}

TEST(Background, PixelsThatShowNothingShowTheEnvironment) {
    Scene scene;
    scene.environment = colored(256);
    Looking l(std::move(scene), 15, 11);
    const IdMap map = l.map(Aov::radiance);
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 15; ++x) {
            const Vec3 direction = l.view.ray(float(x) + 0.5f, float(y) + 0.5f).direction;
            EXPECT_LT(glm::length(map.background.at(x, y) - (2.0f + direction)), 0.01f);
        }
    // Light, and no irradiance.
    for (const Rgb& pixel : l.map(Aov::irradiance).background.pixels) EXPECT_EQ(pixel, Rgb(0));
}

// Pixels of the picture that are larger than those of the map show their mean: of stripes a pixel
// wide, half.
TEST(Background, AFineMapIsAveragedOverThePixel) {
    Scene scene;
    scene.environment.map = Image(512, 256);
    for (int i = 0; i < 512 * 256; i += 2) scene.environment.map.pixels[i] = Rgb(1);
    Looking l(std::move(scene), 15, 15);
    for (const Rgb& pixel : l.map(Aov::radiance).background.pixels)
        EXPECT_NEAR(pixel.r, 0.5f, 0.1f);
}

// A wall covers the right of the picture from the middle of a pixel on: the rest of that pixel is
// sky, as are all to its left.
TEST(Background, AtAnOutlineTheSkyFillsTheRest) {
    Scene scene;
    scene.environment.sky = {4, 2, 1};
    add_wall(scene, 0, 0, 50, add_material(scene, Rgb(0.5f)));
    Looking l(std::move(scene), 15, 15);
    const IdMap map = l.map(Aov::radiance);
    for (int y = 0; y < 15; ++y) {
        EXPECT_EQ(map.background.at(3, y), Rgb(4, 2, 1));
        EXPECT_EQ(map.background.at(12, y), Rgb(0));
        const float rest = map.background.at(7, y).b;
        EXPECT_NEAR(rest, 0.5f, 0.13f);  // 4 columns of rays at unequal places
        EXPECT_NEAR(covered(map, 7, y).r / (0.5f / kPi) + rest, 1, 1e-5f);
    }
}

// Through two blended sheets of alpha 1/4 and 1/2 a ray that then meets nothing keeps 3/8.
TEST(Background, ShowsThroughBlendedSurfacesTimesWhatIsLeft) {
    Scene scene;
    scene.environment.sky = Rgb(8);
    for (const float alpha : {0.25f, 0.5f}) {
        const MaterialId sheet = add_material(scene, Rgb(0));
        scene.materials[index_of(sheet)].alpha_mode = AlphaMode::blend;
        scene.materials[index_of(sheet)].alpha = alpha;
        add_wall(scene, alpha, -50, 50, sheet);
    }
    Looking l(std::move(scene), 15, 15);
    for (const Rgb& pixel : l.map(Aov::radiance).background.pixels) EXPECT_NEAR(pixel.r, 3, 1e-5f);
}

}  // namespace
}  // namespace chiaro
