#include "scene/built_in.h"

#include <gtest/gtest.h>

#include "scene/solids.h"
#include "scene/surface.h"

#include <algorithm>
#include <set>

namespace chiaro {
namespace {

std::vector<Vec3> world_corners(const Scene& scene, const Object& object,
                                const Primitive& primitive) {
    std::vector<Vec3> corners;
    for (int i = 0; i < primitive.corner_count(); ++i)
        corners.push_back(
            Vec3(object.to_world * Vec4(scene.mesh_of(object).positions[primitive.corners[i]], 1)));
    return corners;
}

TEST(BuiltIn, EveryNameIsASceneAndNoOtherIs) {
    EXPECT_EQ(built_in_names(),
              (std::vector<std::string>{"room", "indirect", "poolhall", "cornell"}));
    for (const std::string& name : built_in_names()) EXPECT_TRUE(built_in_scene(name).has_value());
    EXPECT_FALSE(built_in_scene("no such room").has_value());
    EXPECT_FALSE(built_in_scene("").has_value());
}

class BuiltInScene : public testing::TestWithParam<std::string> {
protected:
    const Scene scene = *built_in_scene(GetParam());
};

TEST_P(BuiltInScene, IsSoundLitAndHasACamera) {
    check_scene(scene);
    EXPECT_TRUE(has_light(scene));
    ASSERT_FALSE(scene.cameras.empty());
    EXPECT_EQ(scene.cameras[0].name, "main");
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_P(BuiltInScene, NamesItsObjectsMaterialsAndCamerasOnce) {
    const auto expect_unique = [](const auto& things) {
        std::set<std::string> names;
        for (const auto& thing : things) {
            EXPECT_FALSE(thing.name.empty());
            EXPECT_TRUE(names.insert(thing.name).second) << thing.name;
        }
    };
    expect_unique(scene.objects);
    expect_unique(scene.materials);
    expect_unique(scene.cameras);
}

// Nothing in a house reflects more than fresh white paint, and textures included.
TEST_P(BuiltInScene, ReflectsNoMoreThanPaintDoes) {
    for (const Material& material : scene.materials)
        EXPECT_LE(max_component(material.base_color),
                  material.base_color_texture.used() ? 1 : 0.85f);
    for (const Texture& texture : scene.textures)
        for (const auto& texel : texture.texels)
            for (int c = 0; c < 3; ++c) ASSERT_LE(texel[c], 255 * linear_to_srgb(1));
    for (std::size_t o = 0; o < scene.objects.size(); ++o)
        for (std::uint32_t p = 0; p < scene.mesh_of(scene.objects[o]).primitives.size(); ++p) {
            const Vec4 color = base_color(scene, {static_cast<ObjectId>(o), p, 0.3f, 0.3f});
            EXPECT_LE(max_component(Rgb(color)), 0.85f) << scene.objects[o].name;
            EXPECT_EQ(color.a, 1);
        }
}

TEST_P(BuiltInScene, HasUnitNormalsOnTheFrontOfEveryFace) {
    for (std::size_t o = 0; o < scene.objects.size(); ++o)
        for (std::uint32_t p = 0; p < scene.mesh_of(scene.objects[o]).primitives.size(); ++p) {
            const SurfaceGeometry g =
                surface_geometry(scene, {static_cast<ObjectId>(o), p, 0.4f, 0.4f});
            EXPECT_NEAR(glm::length(g.shading_normal), 1, 1e-4f);
            EXPECT_GT(glm::dot(g.shading_normal, g.geometric_normal), 0.5f)
                << scene.objects[o].name;
        }
    for (const Mesh& mesh : scene.meshes)
        for (const Vec3 n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-4f);
}

TEST_P(BuiltInScene, HasNothingBelowTheFloor) {
    EXPECT_GE(bounds(scene).low.y, -1e-5f);
}

INSTANTIATE_TEST_SUITE_P(Names, BuiltInScene, testing::ValuesIn(built_in_names()));

// The published coordinates over 100, a surface a line, as published: nothing else in the scene.
TEST(CornellBox, HasThePublishedCoordinates) {
    const std::vector<std::pair<std::string, std::vector<Vec3>>> published = {
        {"floor", {{552.8f, 0, 0}, {0, 0, 0}, {0, 0, 559.2f}, {549.6f, 0, 559.2f}}},
        {"lamp", {{343, 548.3f, 227}, {343, 548.3f, 332}, {213, 548.3f, 332}, {213, 548.3f, 227}}},
        {"ceiling", {{556, 548.8f, 0}, {556, 548.8f, 559.2f}, {0, 548.8f, 559.2f}, {0, 548.8f, 0}}},
        {"back wall",
         {{549.6f, 0, 559.2f}, {0, 0, 559.2f}, {0, 548.8f, 559.2f}, {556, 548.8f, 559.2f}}},
        {"green wall", {{0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f}}},
        {"red wall",
         {{552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}}},
        {"short block",
         {{130, 165, 65},  {82, 165, 225},  {240, 165, 272}, {290, 165, 114}, {290, 0, 114},
          {290, 165, 114}, {240, 165, 272}, {240, 0, 272},   {130, 0, 65},    {130, 165, 65},
          {290, 165, 114}, {290, 0, 114},   {82, 0, 225},    {82, 165, 225},  {130, 165, 65},
          {130, 0, 65},    {240, 0, 272},   {240, 165, 272}, {82, 165, 225},  {82, 0, 225}}},
        {"tall block",
         {{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}, {423, 0, 247},
          {423, 330, 247}, {472, 330, 406}, {472, 0, 406},   {472, 0, 406},   {472, 330, 406},
          {314, 330, 456}, {314, 0, 456},   {314, 0, 456},   {314, 330, 456}, {265, 330, 296},
          {265, 0, 296},   {265, 0, 296},   {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}}};

    const Scene scene = *built_in_scene("cornell");
    EXPECT_EQ(scene.objects.size(), published.size());
    EXPECT_EQ(primitive_count(scene), 16u);
    for (const auto& [name, corners] : published) {
        const auto object = std::ranges::find(scene.objects, name, &Object::name);
        ASSERT_NE(object, scene.objects.end()) << name;
        std::vector<Vec3> found;
        for (const Primitive& primitive : scene.mesh_of(*object).primitives)
            for (const Vec3 p : world_corners(scene, *object, primitive)) found.push_back(p);
        ASSERT_EQ(found.size(), corners.size()) << name;
        for (std::size_t i = 0; i < corners.size(); ++i)
            EXPECT_NEAR(glm::length(100.0f * found[i] - corners[i]), 0, 1e-3f) << name << " " << i;
    }
}

// Not mirrored: the camera sees red on its left.
TEST(CornellBox, HasTheRedWallOnTheLeft) {
    const Scene scene = *built_in_scene("cornell");
    const View view(scene.cameras[0], 800, 600);
    EXPECT_GT(view.ray(0, 300).direction.x, 0);  // red is at x = 5.5
    EXPECT_GT(view.ray(400, 0).direction.y, 0);
    EXPECT_GT(view.ray(400, 300).direction.z, 0.9999f);
}

TEST(CornellBox, LampShinesDownAndOnlyDown) {
    const Scene scene = *built_in_scene("cornell");
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const SurfacePoint point = {static_cast<ObjectId>(o), 0, 0.5f, 0.25f};
        const bool lamp = scene.objects[o].name == "lamp";
        EXPECT_EQ(emission(scene, point, true), lamp ? Rgb(17, 12, 4) : Rgb(0));
        EXPECT_EQ(emission(scene, point, false), Rgb(0));
        if (!lamp) continue;
        EXPECT_NEAR(surface_geometry(scene, point).geometric_normal.y, -1, 1e-6f);
    }
}

}  // namespace
}  // namespace chiaro
