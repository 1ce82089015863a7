// Scenes as people make them: read without an error, and with as much in them as their makers say.

#include "import/import_testing.h"
#include "scene/bicubic.h"

namespace chiaro {
namespace {

const std::filesystem::path kScenes = CHIARO_SCENES;

struct Counts {
    std::size_t objects = 0, quads = 0, triangles = 0, patches = 0;
};

Counts count(const Scene& scene) {
    Counts counts;
    counts.objects = scene.objects.size();
    for (const Object& object : scene.objects) {
        const Mesh& mesh = scene.mesh_of(object);
        counts.patches += mesh.bicubics.size();
        counts.quads += mesh.quad_count - mesh.bicubics.size();
        counts.triangles += mesh.primitives.size() - mesh.quad_count;
    }
    return counts;
}

struct Expectation {
    const char* file;
    Counts least, most;  // polygons without area are left out, concave quads become two triangles
    std::size_t lights = 0, cameras = 0;
};

constexpr Expectation kExpected[] = {
    {"cornell_mcguire/CornellBox-Original.obj", {7, 18, 0}, {8, 18, 0}},
    {"cornell_mcguire/CornellBox-Mirror.obj", {7, 18, 0}, {8, 18, 0}},
    {"cornell_mcguire/CornellBox-Sphere.obj", {8, 0, 2188}, {8, 0, 2188}},
    {"cornell_mcguire/CornellBox-Water.obj", {9, 0, 7088}, {9, 0, 7088}},
    {"cornell_data/meshes/cbox_largebox.obj", {1, 0, 12}, {1, 0, 12}},
    {"kitchen_luxcore/kitchen.obj", {20, 0, 82000}, {40, 0, 86032}},
    {"classroom_bitterli/classroom.obj", {70, 0, 103800}, {90, 0, 103832}},
    {"holodeck_mcguire/holodeck.obj", {4, 1700, 203}, {4, 1906, 500}},
    {"occluded_box_lumen/occluded.obj", {10, 1900, 72}, {12, 1938, 150}},
    {"poolhall_kit/poolTable/poolTable.obj", {30, 27000, 1000}, {40, 28032, 3200}},
    {"poolhall_kit/lamp2/lamp2.obj", {30, 4700, 900}, {40, 5700, 2600}},
    {"subdiv_cages/catmark_pawn.obj", {1, 0, 0, 588}, {1, 0, 0, 4 * 588}},
    // Edges between the same two places are told apart by dividing patches.
    {"teaset_bezier/teapot.bpt", {1, 0, 0, 32}, {1, 0, 0, 40}},
    {"teaset_bezier/teacup.bpt", {1, 0, 0, 26}, {1, 0, 0, 28}},
    {"teaset_bezier/teaspoon.bpt", {1, 0, 0, 16}, {1, 0, 0, 24}},
    {"teaset_bezier/teapot_freeform.obj", {32, 0, 0, 32}, {32, 0, 0, 32}},
    {"subdiv_cages/catmark_cube.obj", {1, 6, 0}, {1, 6, 0}},
    {"living_room_godot/living_room.glb", {2, 0, 1500}, {2, 0, 5088}},
    {"gltf_small/CornellBox.glb", {4, 0, 36}, {4, 0, 36}},
    {"gltf_small/Lights.glb", {1, 0, 12}, {1, 0, 12}, 4, 1},
    {"gltf_small/geometry-camera-light.glb", {2, 0, 14}, {2, 0, 14}, 2, 1},
    {"gltf_small/gltf_KHR_lights_punctual_test.glb", {2, 0, 14}, {2, 0, 14}, 3, 1},
    {"gltf_small/03_all_animations.gltf", {3, 0, 976}, {3, 0, 976}},
    {"gltf_small/06_parent-inverse-anim.gltf", {10, 0, 120}, {10, 0, 120}},
};

TEST(RealScenes, HaveTheCountsThatTheirMakersGive) {
    if (!std::filesystem::exists(kScenes)) GTEST_SKIP() << "the scenes are not in " << kScenes;
    for (const Expectation& expected : kExpected) {
        const Scene scene = load_scene(kScenes / expected.file);
        const Counts counts = count(scene);
        const auto within = [&](std::size_t Counts::*kind) {
            return counts.*kind >= expected.least.*kind && counts.*kind <= expected.most.*kind;
        };
        EXPECT_TRUE(within(&Counts::objects)) << expected.file << " " << counts.objects;
        EXPECT_TRUE(within(&Counts::quads)) << expected.file << " " << counts.quads;
        EXPECT_TRUE(within(&Counts::triangles)) << expected.file << " " << counts.triangles;
        EXPECT_TRUE(within(&Counts::patches)) << expected.file << " " << counts.patches;
        EXPECT_EQ(scene.lights.size(), expected.lights) << expected.file;
        EXPECT_EQ(scene.cameras.size(), expected.cameras) << expected.file;
    }
}

TEST(RealScenes, AllOfThemLoad) {
    if (!std::filesystem::exists(kScenes)) GTEST_SKIP() << "the scenes are not in " << kScenes;
    std::size_t loaded = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kScenes)) {
        const std::string name = entry.path().lexically_relative(kScenes).string();
        const std::string extension = entry.path().extension().string();
        if (extension != ".obj" && extension != ".gltf" && extension != ".glb" &&
            extension != ".bpt")
            continue;
        if (name.starts_with("malformed/")) continue;
        const std::string fault = fault_of([&] { load_scene(entry.path()); });
        if (name.ends_with("14_emission_strength.gltf"))
            EXPECT_NE(fault.find("KHR_materials_pbrSpecularGlossiness"), std::string::npos);
        else
            EXPECT_EQ(fault, "");
        ++loaded;
    }
    EXPECT_GT(loaded, 50u);
}

// Both kinds of file of the tea set give the same surfaces, point by point, once the patches of the
// OBJ file are not in a group each.
TEST(RealScenes, TheTeaSetIsTheSameFromBothKindsOfFile) {
    if (!std::filesystem::exists(kScenes)) GTEST_SKIP() << "the scenes are not in " << kScenes;
    for (const char* name : {"teacup", "teapot", "teaspoon"}) {
        const auto file = kScenes / "teaset_bezier" / name;
        const Scene bpt = load_scene(file.string() + ".bpt");
        std::string text = read_text(file.string() + "_freeform.obj");
        for (std::size_t at = 0; (at = text.find("\ng ", at)) != text.npos;) text[at + 1] = '#';
        const Scene obj = TempFolder().load("a.obj", text);
        const auto &patches = bpt.meshes.at(0).bicubics, &others = obj.meshes.at(0).bicubics;
        ASSERT_EQ(patches.size(), others.size()) << name;
        for (std::size_t k = 0; k < patches.size(); ++k)
            EXPECT_EQ(patches[k].points, others[k].points) << name << " " << k;
    }
}

TEST(RealScenes, TheCornellBoxKeepsItsColoursAndItsLamp) {
    if (!std::filesystem::exists(kScenes)) GTEST_SKIP() << "the scenes are not in " << kScenes;
    const Scene scene = load_scene(kScenes / "cornell_mcguire/CornellBox-Original.obj");
    EXPECT_TRUE(has_light(scene));
    for (const Object& object : scene.objects)
        if (object.name == "leftWall") {
            const Mesh& mesh = scene.mesh_of(object);
            EXPECT_EQ(scene.material(mesh.primitives[0].material).base_color,
                      Rgb(0.63f, 0.065f, 0.05f));
        }
}

}  // namespace
}  // namespace chiaro
