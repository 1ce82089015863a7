#include "scene/scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

constexpr auto kNone = Primitive::kNoCorner;
constexpr MaterialId kMaterial{0};

// The unit square, and a fifth point that repeats the first.
Mesh square_points() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    return mesh;
}

Scene one_square() {
    Scene scene;
    Mesh mesh = square_points();
    mesh.primitives = {{{0, 1, 2, 3}, kMaterial}};
    order_primitives(mesh);
    scene.meshes = {mesh};
    scene.objects = {{.name = "square", .mesh = MeshId{0}}};
    scene.materials = {{}};
    return scene;
}

TEST(OrderPrimitives, QuadsComeFirstAndEachKindKeepsItsOrder) {
    Mesh mesh = square_points();
    mesh.primitives = {{{0, 1, 2, kNone}, kMaterial},
                       {{0, 1, 2, 3}, kMaterial},
                       {{0, 2, 3, kNone}, kMaterial},
                       {{1, 2, 3, 0}, kMaterial}};
    EXPECT_EQ(order_primitives(mesh), 0u);
    ASSERT_EQ(mesh.primitives.size(), 4u);
    EXPECT_EQ(mesh.quad_count, 2u);
    EXPECT_EQ(mesh.primitives[0].corners[0], 0u);
    EXPECT_EQ(mesh.primitives[1].corners[0], 1u);
    EXPECT_EQ(mesh.primitives[2].corners[1], 1u);
    EXPECT_EQ(mesh.primitives[3].corners[1], 2u);
}

TEST(OrderPrimitives, AQuadWithTwoCornersInOnePlaceIsATriangle) {
    // Corners 0 and 4 are different points in one place; each neighbouring pair in turn.
    const std::array<std::array<std::uint32_t, 4>, 4> quads = {
        {{0, 4, 1, 2}, {2, 0, 4, 1}, {1, 2, 0, 4}, {4, 1, 2, 0}}};
    for (const auto& corners : quads) {
        Mesh mesh = square_points();
        mesh.primitives = {{corners, kMaterial}};
        EXPECT_EQ(order_primitives(mesh), 0u);
        ASSERT_EQ(mesh.primitives.size(), 1u);
        EXPECT_FALSE(mesh.primitives[0].is_quad());
        EXPECT_EQ(mesh.quad_count, 0u);
        // Still counter-clockwise from +z.
        const auto& c = mesh.primitives[0].corners;
        const Vec3 area = glm::cross(mesh.positions[c[1]] - mesh.positions[c[0]],
                                     mesh.positions[c[2]] - mesh.positions[c[0]]);
        EXPECT_FLOAT_EQ(area.z, 1);
    }
}

TEST(OrderPrimitives, WhatHasNoAreaIsDropped) {
    Mesh mesh = square_points();
    mesh.positions.push_back({2, 0, 0});               // 5: in line with 0 and 1
    mesh.positions.push_back({0.5f, 1e-9f, 0});        // 6: a hair above the line
    mesh.primitives = {{{0, 0, 1, kNone}, kMaterial},  // a repeated corner
                       {{0, 1, 4, kNone}, kMaterial},  // a repeated place
                       {{0, 1, 5, kNone}, kMaterial},  // a line
                       {{0, 1, 6, kNone}, kMaterial},  // a sliver thinner than rounding
                       {{0, 1, 0, 1}, kMaterial},      // there and back
                       {{0, 1, 4, 3}, kMaterial},      // folded on its diagonal
                       {{0, 1, 2, 3}, kMaterial}};
    EXPECT_EQ(order_primitives(mesh), 6u);
    EXPECT_EQ(mesh.primitives.size(), 1u);
    EXPECT_EQ(mesh.quad_count, 1u);
}

TEST(Bounds, AreThoseOfTheObjectsInTheWorld) {
    Scene scene = one_square();
    scene.meshes[0].positions.push_back({100, 0, 0});  // used by nothing
    scene.objects[0].to_world = glm::translate(Mat4(1), {0, 0, 5});
    scene.objects.push_back(
        {.name = "big", .mesh = MeshId{0}, .to_world = glm::scale(Mat4(1), Vec3(-2))});
    const Box box = bounds(scene);
    EXPECT_EQ(box.low, Vec3(-2, -2, 0));
    EXPECT_EQ(box.high, Vec3(1, 1, 5));
    EXPECT_TRUE(bounds(Scene()).empty());
}

TEST(HasLight, NeedsALampOrAnEmissiveSurfaceThatIsShown) {
    Scene scene = one_square();
    EXPECT_FALSE(has_light(scene));
    scene.materials.push_back({.emission = Rgb(1)});
    EXPECT_FALSE(has_light(scene));  // no surface has it
    scene.meshes[0].primitives[0].material = MaterialId{1};
    EXPECT_TRUE(has_light(scene));
    scene.objects.clear();
    EXPECT_FALSE(has_light(scene));  // no object shows it
    scene.lights.push_back({.intensity = Rgb(0)});
    EXPECT_FALSE(has_light(scene));  // the lamp is off
    scene.lights.push_back({.intensity = Rgb(0, 0, 1)});
    EXPECT_TRUE(has_light(scene));
}

TEST(HasLight, NeedsATextureThatIsNotBlackWhereThereIsOne) {
    Scene scene = one_square();
    scene.materials[0].emission = Rgb(1, 0, 0);
    scene.textures = {{.width = 1, .height = 2, .texels = {{0, 0, 0, 255}, {0, 0, 0, 255}}}};
    scene.materials[0].emission_texture.texture = TextureId{0};
    EXPECT_FALSE(has_light(scene));
    scene.textures[0].texels[1] = {0, 255, 0, 255};  // and red emission: black
    EXPECT_FALSE(has_light(scene));
    scene.textures[0].texels[1] = {1, 0, 0, 255};
    EXPECT_TRUE(has_light(scene));
}

TEST(CheckSceneDeathTest, AcceptsASoundSceneAndNamesEachFault) {
    check_scene(one_square());
    check_scene(Scene());
    const auto expect_refused = [](const char* message, const std::function<void(Scene&)>& spoil) {
        Scene scene = one_square();
        spoil(scene);
        EXPECT_DEATH(check_scene(scene), message);
    };
    const float bad = std::numeric_limits<float>::quiet_NaN();
    expect_refused("corner out of range",
                   [](Scene& s) { s.meshes[0].primitives[0].corners[2] = 5; });
    expect_refused("material out of range", [](Scene& s) { s.materials.clear(); });
    expect_refused("mesh out of range", [](Scene& s) { s.objects[0].mesh = MeshId::none; });
    expect_refused("quads must come first", [](Scene& s) { s.meshes[0].quad_count = 0; });
    expect_refused("quad_count out of range", [](Scene& s) { s.meshes[0].quad_count = 2; });
    expect_refused("normal for each point", [](Scene& s) { s.meshes[0].normals = {{0, 0, 1}}; });
    expect_refused("texture coordinates", [](Scene& s) { s.meshes[0].uvs[1] = {{0, 0}}; });
    expect_refused("colour for each point", [](Scene& s) { s.meshes[0].colors = {Vec4(1)}; });
    expect_refused("point is not finite", [=](Scene& s) { s.meshes[0].positions[0].x = bad; });
    expect_refused("not finite", [=](Scene& s) { s.objects[0].to_world[3].y = bad; });
    expect_refused("singular", [](Scene& s) { s.objects[0].to_world[1].y = 0; });
    expect_refused("not affine", [](Scene& s) { s.objects[0].to_world[1].w = 1; });
    expect_refused("texture out of range",
                   [](Scene& s) { s.materials[0].base_color_texture.texture = TextureId{0}; });
    expect_refused("a texture's size", [](Scene& s) { s.textures = {{.width = 2, .height = 2}}; });
    expect_refused("field of view", [](Scene& s) { s.cameras = {{.vertical_fov = 180}}; });
}

}  // namespace
}  // namespace chiaro
