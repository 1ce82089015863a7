// Which direct light can be blocked by what stands in a box, against rays at random.

#include "scene/light_reach.h"
#include "base/random.h"
#include "sample_renderer/tiny_scenes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

Vec3 random_point(Rng& rng, const Box& box) {
    const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
    return box.low + u * (box.high - box.low);
}

bool meets(Vec3 from, Vec3 to, const Box& box) {
    constexpr int kSteps = 400;
    for (int i = 0; i <= kSteps; ++i) {
        const Vec3 p = from + (static_cast<float>(i) / kSteps) * (to - from);
        if (glm::all(glm::greaterThanEqual(p, box.low)) &&
            glm::all(glm::lessThanEqual(p, box.high)))
            return true;
    }
    return false;
}

Scene lamp_at(Vec3 position) {
    Scene scene;
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(1), .position = position});
    return scene;
}

// For a lamp without size the answer is that of the one segment, up to boxes that it just grazes.
TEST(LightReach, OfALampIsOneSegment) {
    Rng rng(1);
    const Box room = {Vec3(-4), Vec3(4)};
    int differ = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 lamp = random_point(rng, room), point = random_point(rng, room);
        const Vec3 low = random_point(rng, room);
        const Box box = {low, low + Vec3(1, 0.5f, 2)};
        const bool may = LightReach(lamp_at(lamp)).may_cross(point, box);
        const bool does = meets(point, lamp, box);
        ASSERT_TRUE(may || !does);
        differ += may != does ? 1 : 0;
    }
    EXPECT_LT(differ, 10);
}

// An area light's box is answered for as a whole: no segment to any point of it is overlooked, and
// at least nine in ten boxes that none of 200 segments meets are let go.
TEST(LightReach, OfAnAreaLightOverlooksNoSegment) {
    Rng rng(2);
    Scene scene;
    const MaterialId glow = tiny::add_material(scene, Rgb(0), Rgb(1));
    Mesh mesh;
    mesh.positions = {{-1, 2, -0.5f}, {1, 2, -0.5f}, {1, 2.2f, 0.5f}, {-1, 2.2f, 0.5f}};
    mesh.primitives = {tiny::quad(0, 1, 2, 3, glow)};
    tiny::add_object(scene, std::move(mesh));
    const LightReach reach(scene);
    const Box light = bounds(scene), floor = {Vec3(-4, -1, -4), Vec3(4, 0, 4)};
    int free = 0, let_go = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 point = random_point(rng, floor);
        const Vec3 low = random_point(rng, {Vec3(-4, -1, -4), Vec3(4, 1.5f, 4)});
        const Box box = {low, low + Vec3(0.5f)};
        bool met = false;
        for (int k = 0; k < 200 && !met; ++k) met = meets(point, random_point(rng, light), box);
        const bool may = reach.may_cross(point, box);
        ASSERT_TRUE(may || !met);
        if (met) continue;
        ++free;
        let_go += may ? 0 : 1;
    }
    EXPECT_GT(let_go, 0.9 * free);
}

// A sun shines along one line; what lies beside it, or behind the point, is in nobody's way.
TEST(LightReach, OfASunIsALine) {
    Scene scene;
    scene.lights.push_back(
        {.kind = LightKind::directional, .intensity = Rgb(1), .direction = Vec3(0, -1, 0)});
    const LightReach reach(scene);
    EXPECT_TRUE(reach.may_cross(Vec3(0), {Vec3(-1, 100, -1), Vec3(1, 101, 1)}));
    EXPECT_FALSE(reach.may_cross(Vec3(0), {Vec3(-1, -101, -1), Vec3(1, -100, 1)}));
    EXPECT_FALSE(reach.may_cross(Vec3(0), {Vec3(2, 100, -1), Vec3(3, 101, 1)}));
}

// Nothing is in the way of lights that are off, or of none.
TEST(LightReach, LightsThatAreOffReachNothing) {
    Scene scene = lamp_at(Vec3(0, 2, 0));
    scene.lights[0].on = false;
    EXPECT_FALSE(LightReach(scene).may_cross(Vec3(0), {Vec3(-1, 1, -1), Vec3(1, 1.5f, 1)}));
    scene.lights[0].on = true;
    EXPECT_TRUE(LightReach(scene).may_cross(Vec3(0), {Vec3(-1, 1, -1), Vec3(1, 1.5f, 1)}));
}

}  // namespace
}  // namespace chiaro
