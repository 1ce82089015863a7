#include "scene/edit.h"

#include "sample_renderer/tiny_scenes.h"
#include "scene/area_lights.h"
#include "scene/edit_history.h"
#include "scene/surface.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include <functional>

namespace chiaro {
namespace {

// A room, a lamp of 1 x 1 that shines down, a box and a point light.
struct Stage {
    Scene scene;
    Camera camera;
    ObjectId lamp, box;
    MaterialId white, glow;

    Stage() {
        white = tiny::add_material(scene, Rgb(0.5f));
        glow = tiny::add_material(scene, Rgb(0), {4, 2, 1});
        tiny::add_room(scene, Vec3(-2), Vec3(2), white);
        lamp = tiny::add_quad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, glow);
        box = tiny::add_box(scene, Vec3(-1), Vec3(-0.5f), white);
        scene.lights.push_back(tiny::point_light(Vec3(0), Rgb(10)));
    }
    Edit apply(const Edit& edit) { return chiaro::apply(scene, camera, edit); }
};

Mat4 shifted(Vec3 by) {
    return glm::translate(Mat4(1), by);
}

bool same(const Object& a, const Object& b) {
    return a.name == b.name && a.mesh == b.mesh && a.to_world == b.to_world && a.shown == b.shown &&
           a.emission_scale == b.emission_scale;
}

// One of every kind that changes what is there.
std::vector<Edit> changes(const Stage& stage) {
    PunctualLight light = stage.scene.lights[0];
    light.position = Vec3(1);
    light.on = false;
    Material material = stage.scene.materials[0];
    material.base_color = Rgb(0.1f);
    return {SetCamera{{.eye = Vec3(3)}}, SetTransform{stage.box, shifted(Vec3(1))},
            SetShown{stage.box, false},  SetEmission{stage.lamp, Rgb(2, 3, 4)},
            SetLight{LightId(0), light}, SetMaterial{stage.white, material}};
}

TEST(Edit, ItsInverseTakesItBack) {
    Stage stage;
    const Stage before = stage;
    for (const Edit& edit : changes(stage)) {
        const Edit inverse = stage.apply(edit);
        EXPECT_EQ(inverse.index(), edit.index());
        stage.apply(inverse);
        EXPECT_EQ(stage.camera.eye, before.camera.eye);
        for (std::size_t i = 0; i < before.scene.objects.size(); ++i)
            EXPECT_TRUE(same(stage.scene.objects[i], before.scene.objects[i]));
        EXPECT_EQ(stage.scene.lights[0].position, before.scene.lights[0].position);
        EXPECT_EQ(stage.scene.lights[0].on, before.scene.lights[0].on);
        EXPECT_EQ(stage.scene.materials[0].base_color, before.scene.materials[0].base_color);
    }
}

// An edit changes nothing once it was made.
TEST(Edit, MadeAgainChangesNothing) {
    Stage stage;
    for (const Edit& edit : changes(stage)) {
        EXPECT_FALSE(changes_nothing(stage.scene, stage.camera, edit));
        stage.apply(edit);
        EXPECT_TRUE(changes_nothing(stage.scene, stage.camera, edit));
    }
}

TEST(Edit, AdditionsStandAtTheEndAndAreHiddenByTheirInverse) {
    Stage stage;
    const std::size_t objects = stage.scene.objects.size();
    Mesh mesh = tiny::box_mesh(Vec3(0), Vec3(1), MaterialId(0), false);
    order_primitives(mesh);
    Material red;
    red.base_color = Rgb(1, 0, 0);
    Object object;
    object.name = "red";
    const Edit undo = stage.apply(AddObject{object, mesh, {red}});
    ASSERT_EQ(stage.scene.objects.size(), objects + 1);
    const auto id = static_cast<ObjectId>(objects);
    EXPECT_EQ(base_color(stage.scene, {id, 0, 0, 0}), Vec4(1, 0, 0, 1));
    check_scene(stage.scene);

    const Edit redo = stage.apply(undo);
    EXPECT_FALSE(stage.scene.objects[objects].shown);
    EXPECT_EQ(stage.scene.objects.size(), objects + 1);
    stage.apply(redo);
    EXPECT_TRUE(stage.scene.objects[objects].shown);

    stage.apply(stage.apply(AddLight{tiny::point_light(Vec3(0), Rgb(1))}));
    ASSERT_EQ(stage.scene.lights.size(), 2u);
    EXPECT_FALSE(stage.scene.lights[1].on);
}

TEST(Edit, WithWhatSceneRefusesEndsTheProgram) {
    Stage stage;
    EXPECT_DEATH(stage.apply(SetShown{ObjectId(9), false}), "object out of range");
    EXPECT_DEATH(stage.apply(SetTransform{stage.box, glm::scale(Mat4(1), Vec3(1, 0, 1))}),
                 "singular");
    EXPECT_DEATH(stage.apply(SetEmission{stage.lamp, Rgb(-1)}), "emission scale");
    EXPECT_DEATH(stage.apply(SetLight{LightId(1), {}}), "light out of range");
    Object astray;
    astray.mesh = MeshId(77);
    EXPECT_DEATH(stage.apply(AddObject{astray}), "mesh out of range");
}

// What is hidden or off is in no list and no bounds.
TEST(Edit, HiddenObjectsAndLightsThatAreOffAreNowhere) {
    Stage stage;
    EXPECT_TRUE(has_light(stage.scene));
    EXPECT_EQ(AreaLights(stage.scene).size(), 1u);
    stage.apply(SetTransform{stage.lamp, shifted({0, 9, 0})});
    EXPECT_EQ(bounds(stage.scene).high.y, 10);
    stage.apply(SetShown{stage.lamp, false});
    EXPECT_EQ(bounds(stage.scene).high.y, 2);
    EXPECT_TRUE(AreaLights(stage.scene).empty());
    EXPECT_TRUE(has_light(stage.scene));

    PunctualLight off = stage.scene.lights[0];
    off.on = false;
    EXPECT_TRUE(arrival(stage.scene.lights[0], Vec3(1)));
    stage.apply(SetLight{LightId(0), off});
    EXPECT_FALSE(has_light(stage.scene));
    EXPECT_FALSE(arrival(stage.scene.lights[0], Vec3(1)));
    EXPECT_EQ(intensity_toward(stage.scene.lights[0], Vec3(1, 0, 0)), Rgb(0));
}

TEST(Edit, EmissionScaleMultipliesRadianceAndPower) {
    Stage stage;
    const SurfacePoint on_lamp = {stage.lamp, 0, 0.5f, 0.5f};
    const float power = AreaLights(stage.scene).power();
    stage.apply(SetEmission{stage.lamp, Rgb(2)});
    EXPECT_EQ(emission(stage.scene, on_lamp, true), Rgb(8, 4, 2));
    EXPECT_NEAR(AreaLights(stage.scene).power(), 2 * power, 1e-5f * power);
    stage.apply(SetEmission{stage.lamp, Rgb(0, 1, 0)});
    EXPECT_EQ(emission(stage.scene, on_lamp, true), Rgb(0, 2, 0));
    stage.apply(SetEmission{stage.lamp, Rgb(0)});
    EXPECT_TRUE(AreaLights(stage.scene).empty());
    EXPECT_FALSE(emits(stage.scene, stage.scene.objects[index_of(stage.lamp)]));
}

TEST(EditEffect, TellsLampsFromOtherThings) {
    Stage stage;
    const EditEffect moved = effect_of(stage.scene, SetTransform{stage.box, shifted({0, 1, 0})});
    EXPECT_TRUE(moved.geometry);
    EXPECT_FALSE(moved.lights || moved.camera);
    EXPECT_EQ(moved.before->low, Vec3(-1));
    EXPECT_EQ(moved.after->low, Vec3(-1, 0, -1));
    EXPECT_TRUE(effect_of(stage.scene, SetTransform{stage.lamp, Mat4(1)}).lights);

    const EditEffect hidden = effect_of(stage.scene, SetShown{stage.lamp, false});
    EXPECT_TRUE(hidden.lights && hidden.geometry && hidden.before && !hidden.after);
    const EditEffect brighter = effect_of(stage.scene, SetEmission{stage.lamp, Rgb(3)});
    EXPECT_TRUE(brighter.lights && !brighter.geometry);

    Material paint = stage.scene.material(stage.white);
    paint.base_color = Rgb(0.2f);
    const EditEffect painted = effect_of(stage.scene, SetMaterial{stage.white, paint});
    EXPECT_TRUE(!painted.lights && !painted.geometry && painted.material == stage.white);
    paint.emission = Rgb(1);
    paint.double_sided = false;
    const EditEffect lit = effect_of(stage.scene, SetMaterial{stage.white, paint});
    EXPECT_TRUE(lit.lights && lit.geometry);
    EXPECT_TRUE(effect_of(stage.scene, SetCamera{}).camera);
}

// What gets through a pane hangs on all that its material is; what gets through a wall, on nothing
// but its becoming one, or its getting holes.
TEST(EditEffect, TellsWhetherOtherLightGetsThrough) {
    Stage stage;
    const MaterialId pane = tiny::add_glossy(stage.scene, Rgb(1), tiny::glass(0, true));
    const auto effect = [&](MaterialId id, const std::function<void(Material&)>& change) {
        Material changed = stage.scene.material(id);
        change(changed);
        return effect_of(stage.scene, SetMaterial{id, changed});
    };
    const auto tinted = [](Material& m) { m.base_color = Rgb(1, 0, 0); };
    const auto rough = [](Material& m) { m.gloss.roughness = 0.5f; };
    const auto opaque = [](Material& m) { m.gloss.transmission = 0; };
    for (const std::function<void(Material&)>& change :
         {std::function<void(Material&)>(tinted), {rough}, {opaque}}) {
        EXPECT_TRUE(effect(pane, change).passing);
        EXPECT_FALSE(effect(stage.white, change).passing);
    }
    EXPECT_FALSE(effect(pane, tinted).geometry || effect(pane, rough).geometry);
    EXPECT_TRUE(effect(pane, opaque).geometry);

    const auto half_there = [](Material& m) {
        m.alpha_mode = AlphaMode::blend;
        m.alpha = 0.5f;
    };
    EXPECT_TRUE(effect(stage.white, half_there).passing);
    EXPECT_TRUE(effect(stage.white, [&](Material& m) { m.gloss = tiny::glass(0, true); }).passing);
}

TEST(EditHistory, StepsAreTakenBackWholeAndMadeAgain) {
    Stage stage;
    EditHistory history;
    const auto apply = [&](const Edit& edit) { return stage.apply(edit); };
    const auto x = [&] { return stage.scene.objects[index_of(stage.box)].to_world[3].x; };
    const auto move = [&](float to, bool same_step) {
        history.add(stage.apply(SetTransform{stage.box, shifted({to, 0, 0})}), same_step);
    };
    move(1, false);
    move(2, true);
    history.add(stage.apply(SetShown{stage.lamp, false}), true);
    move(3, false);

    history.undo(apply);
    EXPECT_EQ(x(), 2);
    history.undo(apply);
    EXPECT_EQ(x(), 0);
    EXPECT_TRUE(stage.scene.objects[index_of(stage.lamp)].shown);
    EXPECT_FALSE(history.can_undo());
    history.undo(apply);
    EXPECT_EQ(x(), 0);

    history.redo(apply);
    EXPECT_EQ(x(), 2);
    EXPECT_FALSE(stage.scene.objects[index_of(stage.lamp)].shown);
    EXPECT_TRUE(history.can_redo());
    move(5, false);
    EXPECT_FALSE(history.can_redo());
    history.undo(apply);
    EXPECT_EQ(x(), 2);
}

}  // namespace
}  // namespace chiaro
