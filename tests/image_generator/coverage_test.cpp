// How much of a pixel each surface takes.
#include "image_generator/looking.h"

#include <gtest/gtest.h>

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

// From inside a closed room every pixel is covered, wholly and no more: reflectances of an
// irradiance map sum to 1.
TEST(Coverage, SumsToOneInAClosedRoom) {
    Scene scene;
    const MaterialId white = add_material(scene, Rgb(0.8f));
    add_room(scene, {-3, -2, -4}, {3.1f, 2.2f, 5}, white);
    add_box(scene, {-1, -2, -2}, {0.7f, 0.3f, -1}, white);
    add_box(scene, {0.5f, -1, 0}, {0.6f, 1.8f, 0.1f}, add_material(scene, Rgb(0.1f, 0.5f, 0.9f)));
    Looking l(std::move(scene), 80, 60, {0.3f, 0.2f, 4.1f}, {0, -0.4f, 0});
    const IdMap map = l.map(Aov::irradiance);
    std::size_t blended = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) {
            const Rgb sum = covered(map, x, y);
            EXPECT_NEAR(sum.r, 1, 1e-5f) << x << ' ' << y;
            EXPECT_EQ(sum, Rgb(sum.r));
            blended += map.at_pixel(static_cast<std::uint32_t>(y * 80 + x)).size() > 1 ? 1 : 0;
        }
    EXPECT_GT(blended, 100u);  // outlines were looked at finely
    for (const Rgb& background : map.background.pixels) EXPECT_EQ(background, Rgb(0));
}

// Fragments are in order of pixels, and first_of_pixel says where each pixel's begin.
TEST(Coverage, FragmentsAreInOrderOfPixels) {
    Scene scene;
    add_room(scene, {-3, -2, -4}, {3, 2, 5}, add_material(scene, Rgb(0.8f)));
    Looking l(std::move(scene), 31, 17);
    const IdMap map = l.map(Aov::radiance);
    EXPECT_EQ(map.first_of_pixel.size(), 31u * 17 + 1);
    EXPECT_EQ(map.first_of_pixel.back(), map.fragments.size());
    for (std::uint32_t p = 0; p < 31 * 17; ++p)
        for (const Fragment& f : map.at_pixel(p)) {
            EXPECT_EQ(f.pixel, p);
            EXPECT_TRUE(l.cache.patch(f.patch).is_root());
            EXPECT_TRUE(std::min(f.local.x, f.local.y) >= 0 && std::max(f.local.x, f.local.y) <= 1);
        }
}

// An edge that covers a part of a pixel takes this part of it, within 1/16; upright and level
// edges, at any part.
TEST(Coverage, OutlinesAreBlendedInProportion) {
    for (int step = 0; step <= 20; ++step) {
        const float part = static_cast<float>(step) / 20;
        Scene upright, level;
        // The middle pixel of 15 x 15 reaches from -4/15 to 4/15.
        const float edge = (2 * part - 1) * 4 / 15;
        add_wall(upright, 0, -50, edge, add_material(upright, Rgb(1)));
        add_wall(level, 0, -50, 50, add_material(level, Rgb(1)), -50, edge);
        for (Scene* scene : {&upright, &level}) {
            Looking l(std::move(*scene), 15, 15);
            EXPECT_NEAR(covered(l.map(Aov::irradiance), 7, 7).g, part, 1.0f / 16) << part;
        }
    }
}

// A wire 0.4 pixels wide is as wide wherever it lies, also where no pixel's centre meets it: its
// parts in a row of pixels sum to 0.4, within 1/16 at each of its two edges.
TEST(Coverage, AWireHasNoGaps) {
    constexpr float kPixel = 8.0f / 15;
    for (int step = 0; step <= 20; ++step) {
        const float left = (static_cast<float>(step) / 20 - 0.5f) * kPixel;
        Scene scene;
        add_wall(scene, 0, left, left + 0.4f * kPixel, add_material(scene, Rgb(1)));
        Looking l(std::move(scene), 15, 15);
        const IdMap map = l.map(Aov::irradiance);
        float sum = 0;
        for (int x = 0; x < 15; ++x) sum += covered(map, x, 7).g;
        EXPECT_NEAR(sum, 0.4f, 2.0f / 16) << left;
    }
}

// Where two walls meet in a pixel each has its part, and together they fill it.
TEST(Coverage, NeighboursShareAPixel) {
    Scene scene;
    add_wall(scene, 0, -50, 0, add_material(scene, {1, 0, 0}));
    add_wall(scene, 0, 0, 50, add_material(scene, {0, 1, 0}));
    Looking l(std::move(scene), 15, 15);
    const IdMap map = l.map(Aov::radiance);
    const Rgb middle = kPi * covered(map, 7, 3);
    EXPECT_NEAR(middle.r, 0.5f, 1.0f / 16);
    EXPECT_NEAR(middle.r + middle.g, 1, 1e-5f);
    EXPECT_NEAR(kPi * covered(map, 6, 3).r, 1, 1e-5f);
    EXPECT_NEAR(kPi * covered(map, 8, 3).g, 1, 1e-5f);
}

// A fragment's place is where the pixel's ray meets the surface.
TEST(Coverage, FragmentsLieUnderTheirPixel) {
    Scene scene;
    add_wall(scene, 0, -10, 10, add_material(scene, Rgb(1)), -9.3f, 12.1f);
    Looking l(std::move(scene), 16, 16);
    const IdMap map = l.map(Aov::radiance);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const auto fragments = map.at_pixel(static_cast<std::uint32_t>(y * 16 + x));
            ASSERT_EQ(fragments.size(), 1u);
            // Pixel centres are half a unit apart from -3.75 on; the wall is 20 wide and 21.4 high.
            EXPECT_NEAR(fragments[0].local.x, (10 - 3.75f + 0.5f * float(x)) / 20, 1e-5f);
            EXPECT_NEAR(fragments[0].local.y, (9.3f + 3.75f - 0.5f * float(y)) / 21.4f, 1e-5f);
        }
}

// A wall has no pinholes: rays that meet the diagonal of a quad, or the edge that two quads share,
// meet the wall. The eye stands before the middle, so that pixels on the picture's diagonals and in
// its middle rows do just that.
TEST(Coverage, AWallHasNoPinholes) {
    Scene one, four;
    add_wall(one, 0, -50, 50, add_material(one, Rgb(1)), -50, 50);
    Mesh mesh;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) mesh.positions.push_back({50 * x, 50 * y, 0});
    const MaterialId material = add_material(four, Rgb(1));
    mesh.primitives = {quad(0, 1, 4, 3, material), quad(1, 2, 5, 4, material),
                       quad(3, 4, 7, 6, material), quad(4, 5, 8, 7, material)};
    add_object(four, std::move(mesh));
    for (Scene* scene : {&one, &four})
        for (const int size : {15, 16, 63, 64}) {
            Looking l(*scene, size, size);
            const IdMap map = l.map(Aov::irradiance);
            int pinholes = 0;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) pinholes += covered(map, x, y).r < 0.999f ? 1 : 0;
            EXPECT_EQ(pinholes, 0) << size;
        }
}

// One ray a pixel: a pixel is covered or it is not.
TEST(Coverage, OneRayAPixelSeesOneSurface) {
    Scene scene;
    add_wall(scene, 0, -50, 0.1f, add_material(scene, Rgb(1)));
    Looking l(std::move(scene), 15, 15);
    RayViewSettings settings;
    settings.quality = ViewQuality::one_ray;
    settings.aov = Aov::irradiance;
    const IdMap map = make_id_map(l.cache, l.caster, l.view, settings, nullptr);
    for (int x = 0; x < 15; ++x) EXPECT_EQ(covered(map, x, 7), Rgb(x <= 7 ? 1.0f : 0.0f));
}

}  // namespace
}  // namespace chiaro
