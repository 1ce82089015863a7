// Light after edits is that of a scene which was always so.

#include "sample_renderer/flat_mirrors.h"
#include "sample_renderer/meter.h"
#include "scene/edit.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

// The Cornell box with a mirror and a point light; what is hidden afterwards comes last.
Scene stage() {
    Scene scene = tiny::cornell_box();
    scene.lights.push_back(tiny::point_light({1, 3, 3}, Rgb(20)));
    return scene;
}

Scene with_hidden_things(Scene scene) {
    const MaterialId lamp = tiny::add_material(scene, Rgb(0), Rgb(30));
    const MaterialId mirror = tiny::add_glossy(scene, Rgb(1), tiny::mirror(Rgb(1)));
    const ObjectId a = tiny::add_quad(scene, {1, 1, 1}, {1, 0, 0}, {0, 0, 1}, lamp);
    const ObjectId b = tiny::add_quad(scene, {4, 1, 1}, {0, 1, 0}, {0, 0, 1}, mirror);
    scene.lights.push_back(tiny::point_light({2, 4, 2}, Rgb(50)));
    Camera camera;
    apply(scene, camera, SetShown{a, false});
    apply(scene, camera, SetShown{b, false});
    PunctualLight off = scene.lights.back();
    off.on = false;
    apply(scene, camera, SetLight{LightId(1), off});
    return scene;
}

class EditedLight : public testing::TestWithParam<tiny::Truth> {};

TEST_P(EditedLight, HiddenThingsAreAsIfTheyWereNotThere) {
    const tiny::Meter with(with_hidden_things(stage()), GetParam());
    const tiny::Meter without(stage(), GetParam());
    for (const Vec3 p : {Vec3(2, 0.01f, 1), Vec3(0.5f, 2, 4)})
        EXPECT_EQ(with.at(p, {0, 1, 0}, Light::total, 64).mean,
                  without.at(p, {0, 1, 0}, Light::total, 64).mean);
}

TEST_P(EditedLight, IrradianceIsProportionalToTheEmissionScale) {
    Scene scene = tiny::cornell_box();
    const tiny::Meter once(scene, GetParam());
    Camera camera;
    apply(scene, camera, SetEmission{ObjectId(5), Rgb(4)});
    const tiny::Meter often(scene, GetParam());
    const Vec3 p(2, 0.01f, 1);
    const Rgb a = once.at(p, {0, 1, 0}, Light::total, 64).mean;
    const Rgb b = often.at(p, {0, 1, 0}, Light::total, 64).mean;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(b[c], 4 * a[c], 1e-4f * b[c]);
}

INSTANTIATE_TEST_SUITE_P(ByRenderer, EditedLight, testing::ValuesIn(tiny::kTruths));

TEST(EditedMirrors, OnlyThoseThatAreShownAreFound) {
    EXPECT_TRUE(find_flat_mirrors(with_hidden_things(stage())).empty());
}

}  // namespace
}  // namespace chiaro
