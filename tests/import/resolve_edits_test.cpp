// Edits by name do what they say to the scene as it was loaded.

#include "import/resolve_edits.h"

#include "base/random.h"
#include "import/import_testing.h"
#include "sample_renderer/tiny_scenes.h"
#include "scene/area_lights.h"
#include "scene/surface.h"

namespace chiaro {
namespace {

// A floor, a chair of two parts, a ceiling panel of 1 x 2 that shines down, and three lights.
struct Stage {
    Scene scene;
    Camera camera = {.eye = {0, 1, 5}, .target = {0, 1, 0}};

    Stage() {
        const MaterialId white = tiny::add_material(scene, Rgb(0.5f));
        const MaterialId glow = tiny::add_material(scene, Rgb(0), {200, 100, 50});
        name(tiny::add_quad(scene, {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, white), "Floor");
        name(tiny::add_box(scene, {1, 0, 1}, {2, 1, 2}, white), "Chair/seat");
        name(tiny::add_box(scene, {1, 1, 1}, {2, 3, 2}, white), "Chair/back");
        name(tiny::add_quad(scene, {-0.5f, 3, -1}, {1, 0, 0}, {0, 0, 2}, glow), "Panel");
        scene.lights = {tiny::point_light({0, 2, 0}, Rgb(10, 20, 30)),
                        tiny::point_light({1, 2, 0}, Rgb(5)), tiny::sun({0, -1, 0}, Rgb(100))};
        scene.lights[1].kind = LightKind::spot;
        scene.lights[0].name = "Bulb";
        scene.lights[1].name = "Spot";
        scene.lights[2].name = "Sun";
    }
    void name(ObjectId id, const char* name) { scene.objects[index_of(id)].name = name; }

    // Makes the edits, each a JSON object.
    Stage& edit(const std::string& edits) {
        const EditScript script = parse_edits("{\"edits\": [" + edits + "]}", "e.json");
        for (const Edit& e : resolve_edits(script, scene, camera)) apply(scene, camera, e);
        check_scene(scene);
        return *this;
    }
    std::string fault(const std::string& edits) {
        return fault_of([&] { edit(edits); });
    }
    const Object& object(const std::string& name) const {
        return *std::ranges::find(scene.objects, name, &Object::name);
    }
    Box box(const std::string& name) const {
        return bounds(scene.mesh_of(object(name)), object(name).to_world);
    }
    ObjectId id(const std::string& name) const {
        return static_cast<ObjectId>(&object(name) - scene.objects.data());
    }
    Rgb radiance(const std::string& name) const {
        return emission(scene, {id(name), 0, 0.5f, 0.5f}, true);
    }
    Vec3 normal(const std::string& name) const {
        return surface_geometry(scene, {id(name), 0, 0.5f, 0.5f}).geometric_normal;
    }
};

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(ResolveEdits, ANameOfSeveralObjectsMovesThemAboutTheirCommonCentre) {
    // Common bounds: 1..2, 0..3, 1..2. A half turn about x swaps seat and back.
    Stage stage;
    stage.edit(R"({"object": "Chair", "rotate": [1, 0, 0, 180], "translate": [1, 0, 0]})");
    expect_near(stage.box("Chair/seat").low, {2, 2, 1});
    expect_near(stage.box("Chair/back").high, {3, 2, 2});
    // Keys that are not given stay; all are relative to the file, not to the edit before.
    stage = Stage();
    stage.edit(R"({"object": "Chair", "translate": [1, 0, 0]},
                  {"object": "Chair", "scale": 2},
                  {"object": "Chair", "translate": [0, 1, 0]})");
    expect_near(stage.box("Chair/seat").low, {0.5f, -0.5f, 0.5f});
}

TEST(ResolveEdits, PartsMayBeNamedAlone) {
    Stage stage;
    stage.edit(R"({"object": "back", "translate": [0, 1, 0]})");
    expect_near(stage.box("Chair/back").low, {1, 2, 1});
    expect_near(stage.box("Chair/seat").low, {1, 0, 1});
}

TEST(ResolveEdits, PunctualLightsKeepWhatIsNotNamed) {
    Stage stage;
    stage.edit(
        R"({"light": "Bulb", "intensity_scale": 0.5}, {"light": "Bulb", "position": [3, 3, 3]},
                  {"light": "Spot", "color": [1, 0, 0], "direction": [2, 0, 0], "on": false})");
    expect_near(stage.scene.lights[0].intensity, {5, 10, 15});
    EXPECT_EQ(stage.scene.lights[0].position, Vec3(3));
    EXPECT_FALSE(stage.scene.lights[1].on);
    EXPECT_EQ(stage.scene.lights[1].direction, Vec3(1, 0, 0));
    EXPECT_NEAR(luminance(stage.scene.lights[1].intensity), 5, 1e-5f);
    EXPECT_EQ(stage.scene.lights[1].intensity.g, 0);
    // Candela are those of the whole light; it keeps its colour through darkness.
    stage.edit(R"({"light": "Bulb", "candela": 0}, {"light": "Bulb", "candela": 7})");
    EXPECT_NEAR(luminance(stage.scene.lights[0].intensity), 7, 1e-4f);
    EXPECT_NEAR(stage.scene.lights[0].intensity.b, 3 * stage.scene.lights[0].intensity.r, 1e-4f);
}

TEST(ResolveEdits, AreaLightsArePlacedByTheirCentreNormalAndSize) {
    Stage stage;
    expect_near(stage.normal("Panel"), {0, -1, 0});
    stage.edit(R"({"light": "Panel", "position": [1, 2, 3], "direction": [3, 0, 0],
                   "size": [4, 6]})");
    const Box box = stage.box("Panel");
    expect_near(box.centre(), {1, 2, 3});
    expect_near(stage.normal("Panel"), {1, 0, 0});
    EXPECT_NEAR(primitive_area(stage.scene, stage.id("Panel"), 0), 24, 1e-3f);
    // It lies level: its width is along x; seen from the side that is up.
    expect_near(box.high - box.low, {0, 4, 6}, 1e-4f);
    stage.edit(R"({"light": "Panel", "direction": [0, 1, 0]})");
    expect_near(stage.normal("Panel"), {0, 1, 0});
}

TEST(ResolveEdits, AreaLightsShineAsTold) {
    Stage stage;
    const float luminance_in_file = luminance({200, 100, 50});
    stage.edit(R"({"light": "Panel", "intensity_scale": 3})");
    expect_near(stage.radiance("Panel"), {600, 300, 150}, 1e-3f);
    stage = Stage();
    stage.edit(R"({"light": "Panel", "color": [1, 1, 1]})");
    expect_near(stage.radiance("Panel"), Rgb(luminance_in_file), 1e-3f);
    stage = Stage();
    stage.edit(R"({"light": "Panel", "nits": 70, "color": [0.5, 1, 0]})");
    EXPECT_NEAR(luminance(stage.radiance("Panel")), 70, 1e-4f);
    EXPECT_NEAR(stage.radiance("Panel").g, 2 * stage.radiance("Panel").r, 1e-4f);
    stage = Stage();
    stage.edit(R"({"light": "Panel", "nits": 70}, {"light": "Panel", "on": false})");
    EXPECT_EQ(stage.radiance("Panel"), Rgb(0));
    stage = Stage();
    stage.edit(R"({"light": "Panel", "nits": 70}, {"light": "Panel", "on": false},
                  {"light": "Panel", "on": true})");
    EXPECT_NEAR(luminance(stage.radiance("Panel")), 70, 1e-4f);
}

TEST(ResolveEdits, MaterialsChangeFromWhatTheFileSays) {
    Stage stage;
    stage.edit(R"({"material": "material0", "base_color": [0, 1, 0.5], "roughness": 0.2},
                  {"material": "material1", "emission_scale": 3},
                  {"material": "material1", "emission_scale": 2})");
    const Material& white = stage.scene.materials[0];
    EXPECT_EQ(white.base_color, Rgb(0, 1, 0.5f));
    EXPECT_EQ(white.gloss.model, GlossModel::metallic_roughness);
    EXPECT_EQ(white.gloss.metallic, 0);
    EXPECT_EQ(white.gloss.roughness, 0.2f);
    EXPECT_EQ(stage.scene.materials[1].emission, Rgb(400, 200, 100));
}

TEST(ResolveEdits, WhatIsRemovedIsHiddenOrOff) {
    Stage stage;
    stage.edit(R"({"remove": "Chair"}, {"remove": "Bulb"})");
    EXPECT_FALSE(stage.object("Chair/seat").shown || stage.object("Chair/back").shown);
    EXPECT_TRUE(stage.object("Floor").shown);
    EXPECT_FALSE(stage.scene.lights[0].on);
    EXPECT_EQ(stage.scene.objects.size(), 4u);
}

TEST(ResolveEdits, NewLightsShineAndCanBeEditedByTheirNames) {
    Stage stage;
    stage.edit(R"({"add": {"light": "P", "type": "area", "position": [0, 2, 0], "size": [1, 0.5],
                           "nits": 30}},
                  {"add": {"light": "S", "type": "spot", "position": [0, 2, 0], "candela": 9,
                           "direction": [1, 0, 0], "cone": [10, 60]}},
                  {"add": {"light": "Q", "type": "point", "position": [1, 2, 0], "candela": 4,
                           "color": [1, 0, 0]}},
                  {"light": "P", "position": [0, 1, 0], "nits": 60},
                  {"light": "S", "candela": 18}, {"material": "P", "emission_scale": 2})");
    expect_near(stage.normal("P"), {0, -1, 0});
    expect_near(stage.box("P").high - stage.box("P").low, {1, 0, 0.5f});
    expect_near(stage.box("P").centre(), {0, 1, 0});
    expect_near(stage.radiance("P"), Rgb(120), 1e-3f);
    const PunctualLight& spot = stage.scene.lights[3];
    EXPECT_EQ(spot.direction, Vec3(1, 0, 0));
    expect_near(spot.intensity, Rgb(18));
    EXPECT_NEAR(spot.outer_cone, glm::radians(60.0f), 1e-6f);
    EXPECT_NEAR(luminance(stage.scene.lights[4].intensity), 4, 1e-5f);
    EXPECT_EQ(AreaLights(stage.scene).size(), 2u);
}

TEST(ResolveEdits, CopiesStandBesideTheirOriginals) {
    Stage stage;
    stage.edit(R"({"object": "Chair", "translate": [9, 0, 0]},
                  {"add": {"object": "Stool", "copy": "Chair", "translate": [0, 5, 0]}},
                  {"object": "Stool", "translate": [0, 0, 1]},
                  {"add": {"object": "Stool 2", "copy": "Stool"}},
                  {"object": "Stool 2.2", "scale": 2})");
    ASSERT_EQ(stage.scene.objects.size(), 8u);
    expect_near(stage.box("Stool").low, {1, 5, 2});
    expect_near(stage.box("Stool.2").low, {1, 6, 2});
    expect_near(stage.box("Stool 2").low, {1, 5, 1});
    expect_near(stage.box("Stool 2.2").high - stage.box("Stool 2.2").low, {2, 4, 2});
    EXPECT_EQ(stage.object("Stool").mesh, stage.object("Chair/seat").mesh);
}

TEST(ResolveEdits, TheCameraKeepsWhatIsNotNamed) {
    Stage stage;
    stage.edit(R"({"camera": {"eye": [1, 2, 3]}}, {"camera": {"vfov": 30}})");
    EXPECT_EQ(stage.camera.eye, Vec3(1, 2, 3));
    EXPECT_EQ(stage.camera.target, Vec3(0, 1, 0));
    EXPECT_EQ(stage.camera.vertical_fov, 30);
}

TEST(ResolveEdits, WhatIsNotThereIsNamedWithWhatIs) {
    Stage stage;
    EXPECT_EQ(stage.fault(R"({"object": "Vase", "scale": 2})"),
              "e.json: edits[0].object: there is no object \"Vase\"; there are Chair/back, "
              "Chair/seat, Floor, Panel");
    EXPECT_EQ(stage.fault(R"({"light": "Vase", "on": true})"),
              "e.json: edits[0].light: there is no light \"Vase\"; there are Bulb, Spot, "
              "Sun, Panel");
    EXPECT_EQ(stage.fault(R"({"light": "Floor", "on": true})"),
              "e.json: edits[0].light: the object \"Floor\" does not shine; there are Bulb, Spot, "
              "Sun, Panel");
    EXPECT_EQ(stage.fault(R"({"material": "Wood"})"),
              "e.json: edits[0].material: there is no material \"Wood\"; there are material0, "
              "material1");
    EXPECT_NE(stage.fault(R"({"remove": "Vase"})").find("there is no object or light \"Vase\""),
              std::string::npos);
    EXPECT_NE(stage.fault(R"({"add": {"object": "A", "copy": "Vase"}})").find("edits[0].add.copy"),
              std::string::npos);
}

TEST(ResolveEdits, KeysThatALightDoesNotHaveAreErrors) {
    Stage stage;
    EXPECT_EQ(stage.fault(R"({"light": "Panel", "candela": 3})"),
              "e.json: edits[0].candela: this light has none; an area light has position, "
              "direction, size, nits, intensity_scale, color and on");
    EXPECT_EQ(stage.fault(R"({"light": "Bulb", "nits": 3})"),
              "e.json: edits[0].nits: this light has none; a point light has position, candela, "
              "intensity_scale, color and on");
    EXPECT_NE(stage.fault(R"({"light": "Bulb", "direction": [1, 0, 0]})"), "");
    EXPECT_NE(stage.fault(R"({"light": "Sun", "position": [1, 0, 0]})"), "");
    EXPECT_NE(stage.fault(R"({"light": "Spot", "size": [1, 1]})"), "");
}

TEST(ResolveEdits, WhatNoSceneMayHaveIsRefused) {
    Stage stage;
    EXPECT_EQ(stage.fault(R"({"add": {"object": "Bulb", "copy": "Floor"}})"),
              "e.json: edits[0].add.object: the name \"Bulb\" is taken; choose another");
    EXPECT_EQ(stage.fault(R"({"object": "Floor", "translate": [1e9, 0, 0], "scale": 1000})"),
              "e.json: edits[0]: moves something beyond 1e9");
    EXPECT_EQ(stage.fault(R"({"light": "Bulb", "intensity_scale": 9e14})"),
              "e.json: edits[0].light: is brighter than 1e15");
    EXPECT_EQ(stage.fault(R"({"camera": {"eye": [0, 1, 0]}})"),
              "e.json: edits[0].camera: its target is where its eye is; move one of them");
}

// Whatever the numbers, an edit is refused or leaves a scene that keeps its promises.
TEST(ResolveEdits, ExtremeNumbersAreRefusedOrFine) {
    constexpr const char* kNumbers[] = {"0",   "1",   "-1",  "1e-9", "-1e-6", "1e-6", "30",
                                        "0.5", "1e6", "1e9", "-1e9", "1e15",  "180"};
    constexpr const char* kEdits[] = {
        R"({"object": "Chair", "translate": [#,#,#], "rotate": [#,#,#,#], "scale": #})",
        R"({"light": "Panel", "position": [#,#,#], "direction": [#,#,#], "size": [#,#]})",
        R"({"light": "Panel", "nits": #, "color": [#,#,#]})",
        R"({"light": "Panel", "intensity_scale": #})",
        R"({"light": "Spot", "position": [#,#,#], "direction": [#,#,#], "candela": #})",
        R"({"light": "Bulb", "intensity_scale": #, "color": [#,#,#]})",
        R"({"camera": {"eye": [#,#,#], "target": [#,#,#], "up": [#,#,#], "vfov": #}})",
        R"({"material": "material1", "base_color": [#,#,#], "roughness": #, "emission_scale": #})",
        R"({"add": {"light": "A", "type": "area", "position": [#,#,#], "direction": [#,#,#],
            "size": [#,#], "nits": #}}, {"light": "A", "size": [#,#], "direction": [#,#,#]})",
        R"({"add": {"object": "B", "copy": "Panel", "translate": [#,#,#], "scale": #}},
           {"light": "B", "direction": [#,#,#], "nits": #})"};
    Rng rng(2002);
    const auto pick = [&](const auto& list) {
        return std::string(list[rng.below(static_cast<std::uint32_t>(std::size(list)))]);
    };
    int refused = 0;
    constexpr int kTries = 4000;
    for (int i = 0; i < kTries; ++i) {
        std::string edits = pick(kEdits) + "," + pick(kEdits);
        for (std::size_t at = edits.find('#'); at != edits.npos; at = edits.find('#'))
            edits.replace(at, 1, rng.below(2) == 0 ? "1" : pick(kNumbers));
        Stage stage;
        if (!stage.fault(edits).empty()) ++refused;
        check_scene(stage.scene);
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, kTries);
}

// Names of nodes stand for all that hangs on them, lights too.
TEST(ResolveEdits, NodesCarryTheirChildren) {
    GltfMaker maker = triangle_gltf();
    maker.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    maker.root["nodes"] = {{{"name", "Lamp"}, {"children", {1, 2}}},
                           {{"mesh", 0}, {"name", "shade"}},
                           {{"name", "bulb"},
                            {"translation", {0, 1, 0}},
                            {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    const TempFolder folder;
    Scene scene = folder.load("a.gltf", maker.text());
    Camera camera;
    const EditScript script = parse_edits(
        R"({"edits": [{"object": "Lamp", "translate": [0, 0, 2]},
                      {"add": {"object": "Lamp 2", "copy": "Lamp", "translate": [7, 0, 0]}},
                      {"light": "Lamp", "candela": 5}]})",
        "e");
    for (const Edit& e : resolve_edits(script, scene, camera)) apply(scene, camera, e);
    EXPECT_EQ(scene.objects[0].to_world[3].z, 2);
    EXPECT_EQ(scene.lights[0].position, Vec3(0, 1, 2));
    EXPECT_NEAR(luminance(scene.lights[0].intensity), 5, 1e-5f);
    EXPECT_EQ(scene.objects[1].to_world[3].x, 7);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[1].position, Vec3(7, 1, 0));
}

}  // namespace
}  // namespace chiaro
