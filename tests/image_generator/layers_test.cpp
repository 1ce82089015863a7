// Surfaces that the camera looks through, or does not see at all.
#include "image_generator/looking.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

MaterialId add_blended(Scene& scene, Rgb color, float alpha) {
    const MaterialId id = add_material(scene, color);
    scene.materials[index_of(id)].alpha_mode = AlphaMode::blend;
    scene.materials[index_of(id)].alpha = alpha;
    return id;
}

// The parts of the middle pixel, front to back.
std::vector<float> parts_in_the_middle(Looking& l) {
    const IdMap map = l.map(Aov::irradiance);
    std::vector<float> parts;
    for (const Fragment& f : map.at_pixel(static_cast<std::uint32_t>(7 * 15 + 7)))
        parts.push_back(f.reflectance.r);
    return parts;
}

// Single-sided faces are passed from behind: what is behind them shows. Double-sided ones show
// their back, which has a root of its own.
TEST(Layers, SingleSidedFacesAreInvisibleFromBehind) {
    for (const bool double_sided : {false, true}) {
        Scene scene;
        const MaterialId near_material = add_material(scene, {1, 0, 0});
        scene.materials[index_of(near_material)].double_sided = double_sided;
        // Turned away: its front looks along -z.
        add_quad(scene, {50, -50, 1}, {-100, 0, 0}, {0, 91.7f, 0}, near_material);
        add_wall(scene, 0, -50, 50, add_material(scene, {0, 1, 0}));
        Looking l(std::move(scene), 15, 15);
        const IdMap map = l.map(Aov::radiance);
        for (const Fragment& f : map.fragments) {
            EXPECT_EQ(l.cache.surface_side(f.patch), double_sided ? 1u : 2u);
            EXPECT_NEAR(f.reflectance[double_sided ? 0 : 1], 1 / kPi, 1e-6f);
        }
        EXPECT_EQ(map.fragments.size(), 15u * 15);
    }
}

// Of two single-sided faces back to back the one that faces the camera shows, from either side.
TEST(Layers, CoincidentSingleSidedFacesShowTheirFronts) {
    for (const float side : {1.0f, -1.0f}) {
        Scene scene;
        const MaterialId sheet = add_material(scene, Rgb(1));
        scene.materials[index_of(sheet)].double_sided = false;
        add_wall(scene, 0, -50, 50, sheet);                                 // front toward +z
        add_quad(scene, {-50, -50, 0}, {0, 91.7f, 0}, {100, 0, 0}, sheet);  // toward -z
        Looking l(std::move(scene), 15, 15, {0, 0, 4 * side});
        const IdMap map = l.map(Aov::irradiance);
        EXPECT_EQ(map.fragments.size(), 15u * 15);
        for (const Fragment& f : map.fragments)
            EXPECT_EQ(l.cache.surface_side(f.patch), side > 0 ? 0u : 2u);
    }
}

// From its front a single-sided face is seen as any other.
TEST(Layers, SingleSidedFacesAreVisibleFromTheFront) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(1));
    scene.materials[index_of(material)].double_sided = false;
    add_wall(scene, 0, -50, 50, material);
    Looking l(std::move(scene), 15, 15);
    EXPECT_EQ(parts_in_the_middle(l), std::vector<float>{1});
}

// Composited front to back: of alpha 1/2 before a wall each is half of the pixel.
TEST(Layers, ABlendedSurfaceLeavesTheRestToTheWallBehind) {
    Scene scene;
    add_wall(scene, 1, -50, 50, add_blended(scene, Rgb(1), 0.5f));
    add_wall(scene, 0, -50, 50, add_material(scene, Rgb(1)));
    Looking l(std::move(scene), 15, 15);
    EXPECT_EQ(parts_in_the_middle(l), (std::vector<float>{0.5f, 0.5f}));
}

// Layers of alpha a take (1 - a)^n a each: 1/4, 3/16, 9/64, and the wall 27/64.
TEST(Layers, ManyLayersFadeGeometrically) {
    Scene scene;
    for (int i = 3; i > 0; --i)
        add_wall(scene, static_cast<float>(i), -50, 50, add_blended(scene, Rgb(1), 0.25f));
    add_wall(scene, 0, -50, 50, add_material(scene, Rgb(1)));
    Looking l(std::move(scene), 15, 15);
    const auto parts = parts_in_the_middle(l);
    ASSERT_EQ(parts.size(), 4u);
    const std::array<float, 4> expected = {16, 12, 9, 27};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(parts[i], expected[i] / 64, 1e-5f);
}

// Blended surfaces in one place count each: 1/2, 1/4, and 1/4 of the wall behind them, which may be
// as near as floats can tell.
TEST(Layers, BlendedSurfacesInOnePlaceAreAllSeen) {
    for (const float behind : {1.0f, 1e-6f}) {
        Scene scene;
        const MaterialId half = add_blended(scene, Rgb(1), 0.5f);
        add_wall(scene, 0, -50, 50, half);
        add_wall(scene, 0, -50, 50, half);
        add_wall(scene, -behind, -50, 50, add_material(scene, Rgb(1)));
        Looking l(std::move(scene), 15, 15);
        EXPECT_EQ(parts_in_the_middle(l), (std::vector<float>{0.5f, 0.25f, 0.25f}));
    }
}

// A lamp behind a pane of alpha 0.95 keeps its twentieth, though a pixel at a lamp is looked at by
// 64 rays that each are little of it.
TEST(Layers, LittleOfALampIsStillSeen) {
    Scene scene;
    add_wall(scene, 1, -50, 50, add_blended(scene, Rgb(0), 0.95f));
    add_wall(scene, 0, -50, 50, add_material(scene, Rgb(0), Rgb(100)));
    add_wall(scene, 2, 0.14f, 50, add_material(scene, Rgb(0), Rgb(1)));  // in the next pixel
    Looking l(std::move(scene), 15, 15);
    EXPECT_NEAR(l.map(Aov::radiance).background.at(7, 7).r, 5, 1e-3f);
}

// Alpha 0 is nothing, alpha 1 is all.
TEST(Layers, TheEndsOfAlpha) {
    for (const float alpha : {0.0f, 1.0f}) {
        Scene scene;
        add_wall(scene, 1, -50, 50, add_blended(scene, Rgb(1), alpha));
        add_wall(scene, 0, -50, 50, add_material(scene, Rgb(1)));
        Looking l(std::move(scene), 15, 15);
        const IdMap map = l.map(Aov::irradiance);
        for (const Fragment& f : map.fragments)
            EXPECT_EQ(l.cache.surface_side(f.patch), alpha == 0 ? 2u : 0u);
        EXPECT_NEAR(covered(map, 7, 7).r, 1, 1e-5f);
    }
}

// Emission needs no shading: it goes to the background, in proportion to what it covers; an
// irradiance map leaves it out.
TEST(Layers, EmissionGoesToTheBackground) {
    Scene scene;
    add_wall(scene, 0, -50, 0, add_material(scene, Rgb(0), {30, 20, 10}));
    Looking l(std::move(scene), 15, 15);
    const IdMap map = l.map(Aov::radiance);
    EXPECT_NEAR(glm::length(map.background.at(3, 7) - Rgb(30, 20, 10)), 0, 1e-4f);
    EXPECT_NEAR(map.background.at(7, 7).r, 15, 30.0f / 16);
    EXPECT_EQ(map.background.at(11, 7), Rgb(0));
    EXPECT_EQ(covered(map, 3, 7), Rgb(0));  // base colour black
    const IdMap lux = l.map(Aov::irradiance);
    for (const Rgb& pixel : lux.background.pixels) EXPECT_EQ(pixel, Rgb(0));
}

// An emissive surface seen through glass is dimmed by it; its back is dark unless it emits
// backward.
TEST(Layers, EmissionIsSeenThroughLayersAndFromItsFront) {
    Scene scene;
    add_wall(scene, 1, -50, 50, add_blended(scene, Rgb(0), 0.75f));
    add_wall(scene, 0, -50, 50, add_material(scene, Rgb(0), Rgb(8)));
    Looking l(std::move(scene), 15, 15);
    EXPECT_NEAR(l.map(Aov::radiance).background.at(7, 7).r, 2, 1e-4f);

    for (const bool backward : {false, true}) {
        Scene turned;
        const MaterialId lamp = add_material(turned, Rgb(0), Rgb(8));
        turned.materials[index_of(lamp)].emits_backward = backward;
        add_quad(turned, {50, -50, 0}, {-100, 0, 0}, {0, 91.7f, 0}, lamp);
        Looking behind(std::move(turned), 15, 15);
        EXPECT_NEAR(behind.map(Aov::radiance).background.at(7, 7).r, backward ? 8 : 0, 1e-4f);
    }
}

// What the camera sees is known to be open: the front that was seen, so that its back is the
// inside.
TEST(Layers, MarksTheSidesThatWereSeen) {
    Scene scene;
    add_wall(scene, 0, -50, 50, add_material(scene, Rgb(1)));
    Looking l(std::move(scene), 15, 15);
    OpenSides open(l.scene);
    EXPECT_FALSE(open.is_inside(ObjectId{0}, 0, false));
    make_id_map(l.cache, l.caster, l.view, {}, &open);
    EXPECT_TRUE(open.is_inside(ObjectId{0}, 0, false));
    EXPECT_FALSE(open.is_inside(ObjectId{0}, 0, true));
}

}  // namespace
}  // namespace chiaro
