// The scenes of the paper's table 1, written anew: of its sizes, and as real as furniture is.

#include "scene/built_in.h"
#include "scene/pool_balls.h"
#include "scene/pool_table.h"
#include "scene/solids.h"
#include "scene/surface.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chiaro {
namespace {

std::vector<std::string> curved_objects(const Scene& scene) {
    std::vector<std::string> names;
    for (const Object& object : scene.objects)
        if (!scene.mesh_of(object).bicubics.empty()) names.push_back(object.name);
    return names;
}

// Emitting panels: solids of objects that emit.
int area_light_count(const Scene& scene) {
    int count = 0;
    for (const Object& object : scene.objects)
        for (const auto& [root, primitives] : solids_of(scene.mesh_of(object)))
            count += std::ranges::any_of(primitives, [&](const Primitive* p) {
                return scene.material(p->material).emissive();
            });
    return count;
}

struct Size {
    const char* name;
    std::size_t fewest, most, curved;
    int area_lights;
    std::size_t point_lights;
};

TEST(PaperScenes, HaveTheSizesOfTheTable) {
    const Size sizes[] = {{"room", 3600, 4400, 9, 1, 0},
                          {"indirect", 280, 320, 2, 1, 0},
                          {"poolhall", 9000, 11'000, 15, 0, 11}};
    for (const Size& size : sizes) {
        const Scene scene = *built_in_scene(size.name);
        EXPECT_GE(primitive_count(scene), size.fewest) << size.name;
        EXPECT_LE(primitive_count(scene), size.most) << size.name;
        EXPECT_EQ(curved_objects(scene).size(), size.curved) << size.name;
        EXPECT_EQ(area_light_count(scene), size.area_lights) << size.name;
        EXPECT_EQ(scene.lights.size(), size.point_lights) << size.name;
        EXPECT_GE(scene.cameras.size(), 3u) << size.name;
    }
}

TEST(PaperScenes, RoomHasATeaSetAmongItsCurvedObjects) {
    const std::vector<std::string> curved = curved_objects(*built_in_scene("room"));
    for (const char* name : {"Teapot", "Cup 1", "Cup 2", "Spoon"})
        EXPECT_NE(std::ranges::find(curved, name), curved.end()) << name;
}

// Every material of a curved ball is glossy and textured, and every ball lies on the cloth without
// touching another.
TEST(PaperScenes, BallsLieOnTheClothApart) {
    const Scene scene = *built_in_scene("poolhall");
    std::vector<Vec3> centres;
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.mesh_of(object);
        if (mesh.bicubics.empty()) continue;
        for (const Primitive& primitive : mesh.primitives) {
            EXPECT_NE(scene.material(primitive.material).gloss.model, GlossModel::none);
            EXPECT_TRUE(scene.material(primitive.material).base_color_texture.used());
        }
        centres.push_back(Vec3(object.to_world[3]));
        EXPECT_NEAR(centres.back().y, kClothHeight + kBallRadius, 1e-5f) << object.name;
    }
    ASSERT_EQ(centres.size(), 15u);
    for (std::size_t i = 0; i < centres.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_GT(glm::distance(centres[i], centres[j]), 2 * kBallRadius) << i << " " << j;
}

TEST(PaperScenes, SolidsFaceOutward) {
    const std::pair<const char*, std::vector<std::string>> solid[] = {
        {"indirect", {"Chair", "Bench", "Plinth", "Sculpture", "Vase", "Rug"}},
        {"poolhall",
         {"Stool", "Bar", "Bottle 1", "Cue", "Ball rack", "Cue ball", "Ball 9", "Beam",
          "Cue rack"}}};
    for (const auto& [name, meshes] : solid) {
        const Scene scene = *built_in_scene(name);
        std::size_t tested = 0;
        for (const Mesh& mesh : scene.meshes) {
            if (std::ranges::find(meshes, mesh.name) == meshes.end()) continue;
            ++tested;
            for (const auto& [root, primitives] : solids_of(mesh))
                EXPECT_GE(outwardness(mesh, primitives), -1e-12) << name << ": " << mesh.name;
        }
        EXPECT_EQ(tested, meshes.size()) << name;
    }
}

// A nine-foot table: the field as the rules have it, the rails at the height of a real one.
TEST(PaperScenes, PoolTableHasRealProportions) {
    EXPECT_EQ(2.0f * kHalfField, Vec2(1.27f, 2.54f));
    EXPECT_FLOAT_EQ(2 * kBallRadius, 0.05715f);
    const Scene scene = *built_in_scene("poolhall");
    const auto table = std::ranges::find(scene.meshes, "Pool table", &Mesh::name);
    ASSERT_NE(table, scene.meshes.end());
    Box box;
    for (const Vec3 p : table->positions) box.add(p);
    EXPECT_NEAR(box.high.y, 0.8f, 0.02f);
    EXPECT_NEAR(box.high.x - box.low.x, 1.6f, 0.05f);
    EXPECT_NEAR(box.high.z - box.low.z, 2.87f, 0.05f);
}

}  // namespace
}  // namespace chiaro
