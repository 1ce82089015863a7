// A ray caster that follows edits meets what one that is built on the edited scene meets.

#include "rays/casting.h"
#include "scene/edit.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

using tiny::random_rays;

struct Stage {
    Scene scene;
    Camera camera;
    ObjectId box, pane;
    MaterialId white, other;

    Stage() {
        white = tiny::add_material(scene, Rgb(0.8f));
        other = tiny::add_material(scene, Rgb(0.8f));
        tiny::add_room(scene, Vec3(-3), Vec3(3), white);
        box = tiny::add_box(scene, Vec3(-1, -1, -2), Vec3(1, 1, -1), white);
        pane = tiny::add_quad(scene, {-2, -2, 1}, {4, 0, 0}, {0, 4, 0}, other);
    }
    void apply(const Edit& edit) { chiaro::apply(scene, camera, edit); }
};

void expect_same_hits(const RayCaster& a, const RayCaster& b) {
    const std::vector<Ray> rays = random_rays(4000, {0.1f, 0.2f, 0.3f});
    for (const RayKind kind : {RayKind::transport, RayKind::camera}) {
        std::vector<Hit> one(rays.size()), two(rays.size());
        a.intersect(rays, one, kind);
        b.intersect(rays, two, kind);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(one[i].point.object, two[i].point.object);
            EXPECT_EQ(one[i].t, two[i].t);
        }
    }
    std::vector<Rgb> one(rays.size()), two(rays.size());
    a.transmittance(rays, one);
    b.transmittance(rays, two);
    EXPECT_EQ(one, two);
}

TEST(RayCasterEdits, NoRayMeetsWhatIsHidden) {
    Stage stage;
    RayCaster caster(stage.scene, 1);
    const Ray ray = {{0, 0, 0}, {0, 0, -1}};
    EXPECT_EQ(tiny::cast(caster, ray).point.object, stage.box);
    for (int turn = 0; turn < 2; ++turn) {
        stage.apply(SetShown{stage.box, false});
        caster.set_shown(stage.box);
        EXPECT_EQ(tiny::cast(caster, ray).t, 3);
        expect_same_hits(caster, RayCaster(stage.scene, 1));
        stage.apply(SetShown{stage.box, true});
        caster.set_shown(stage.box);
        EXPECT_EQ(tiny::cast(caster, ray).t, 1);
    }
}

TEST(RayCasterEdits, ASceneWithAHiddenObjectIsThatWithoutIt) {
    Stage stage;
    Scene without = stage.scene;
    without.objects.pop_back();
    stage.apply(SetShown{stage.pane, false});
    expect_same_hits(RayCaster(stage.scene, 1), RayCaster(without, 1));
}

TEST(RayCasterEdits, ObjectsAndMeshesMayBeAdded) {
    Stage stage;
    RayCaster caster(stage.scene, 1);
    Mesh mesh = tiny::box_mesh(Vec3(1.2f), Vec3(1.6f), MaterialId(0), false);
    order_primitives(mesh);
    Material glass;
    glass.alpha_mode = AlphaMode::blend;
    glass.alpha = 0.5f;
    glass.double_sided = false;
    Object object;
    stage.apply(AddObject{object, mesh, {glass}});
    object.mesh = MeshId(1);
    object.to_world = glm::translate(Mat4(1), Vec3(-1, -2, 0));
    stage.apply(AddObject{object});
    caster.add_objects();
    expect_same_hits(caster, RayCaster(stage.scene, 1));

    stage.apply(SetShown{ObjectId(3), false});
    caster.set_shown(ObjectId(3));
    expect_same_hits(caster, RayCaster(stage.scene, 1));
}

TEST(RayCasterEdits, MaterialsMayBecomeGlassAndOpaqueAgain) {
    Stage stage;
    RayCaster caster(stage.scene, 1);
    const Material opaque = stage.scene.material(stage.other);
    Material glass = opaque;
    glass.gloss = tiny::glass(0, true);
    Material behind = opaque;
    behind.double_sided = false;
    for (const Material& material : {glass, behind, opaque}) {
        stage.apply(SetMaterial{stage.other, material});
        caster.set_material(stage.other);
        expect_same_hits(caster, RayCaster(stage.scene, 1));
    }
}

// Also where it has curves that are made for the eye.
TEST(RayCasterEdits, NoRayFromTheEyeMeetsHiddenCurves) {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(0.8f));
    Mesh mesh;
    BicubicPatch patch;
    for (int k = 0; k < 16; ++k)
        patch.points[k] = Vec4(static_cast<float>(k % 4), static_cast<float>(k / 4), 0, 1);
    mesh.bicubics = {patch};
    mesh.positions = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}};
    mesh.primitives = {tiny::quad(0, 1, 2, 3, white)};
    const ObjectId curve = tiny::add_object(scene, mesh);
    Camera camera;
    RayCaster caster(scene, 1);
    const auto show = [&] {
        const auto tolerance = [](const Box&) { return 1e-3f; };
        std::vector<ShownCurves> shown;
        shown.push_back({curve, tessellate(scene.meshes[0].bicubics, tolerance, 1)});
        caster.show_curves(std::move(shown));
    };
    const auto meets = [&](RayKind kind) {
        return bool(tiny::cast(caster, {{1, 1.2f, 2}, {0, 0, -1}}, kind));
    };
    show();
    ASSERT_TRUE(meets(RayKind::camera));
    apply(scene, camera, SetShown{curve, false});
    caster.set_shown(curve);
    EXPECT_FALSE(meets(RayKind::camera) || meets(RayKind::transport));
    show();
    EXPECT_FALSE(meets(RayKind::camera) || meets(RayKind::transport));
    apply(scene, camera, SetShown{curve, true});
    caster.set_shown(curve);
    EXPECT_TRUE(meets(RayKind::camera) && meets(RayKind::transport));
}

}  // namespace
}  // namespace chiaro
