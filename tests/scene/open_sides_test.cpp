#include "scene/open_sides.h"

#include "sample_renderer/tiny_scenes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

Scene two_boxes() {
    Scene scene;
    const MaterialId white = tiny::add_material(scene, Rgb(0.8f));
    tiny::add_box(scene, Vec3(0), Vec3(1), white);
    tiny::add_box(scene, Vec3(2), Vec3(3), white);
    return scene;
}

TEST(OpenSides, NothingIsKnownAtFirst) {
    const OpenSides sides(two_boxes());
    EXPECT_FALSE(sides.is_inside(ObjectId(0), 0, true));
    EXPECT_FALSE(sides.is_inside(ObjectId(0), 0, false));
}

TEST(OpenSides, TheOtherSideOfAMarkedPrimitiveIsInside) {
    OpenSides sides(two_boxes());
    sides.mark(ObjectId(0), 2, true);
    EXPECT_TRUE(sides.is_inside(ObjectId(0), 2, false));
    EXPECT_FALSE(sides.is_inside(ObjectId(0), 2, true));
    sides.mark(ObjectId(0), 2, false);  // a sheet that is seen from both sides has no inside
    EXPECT_FALSE(sides.is_inside(ObjectId(0), 2, false));
}

// A primitive without marks follows nine tenths of its object, and never another object.
TEST(OpenSides, UnmarkedPrimitivesFollowTheirObject) {
    OpenSides sides(two_boxes());
    for (std::uint32_t p = 0; p < 5; ++p) sides.mark(ObjectId(0), p, true);
    EXPECT_TRUE(sides.is_inside(ObjectId(0), 5, false));
    EXPECT_FALSE(sides.is_inside(ObjectId(0), 5, true));
    EXPECT_FALSE(sides.is_inside(ObjectId(1), 5, false));
    sides.mark(ObjectId(0), 0, false);  // now 4 of 5
    EXPECT_FALSE(sides.is_inside(ObjectId(0), 5, false));
}

// What was marked stays so when the scene grows.
TEST(OpenSides, ObjectsMayBeAdded) {
    Scene scene = two_boxes();
    OpenSides sides(scene);
    sides.mark(ObjectId(0), 2, true);
    scene.objects.push_back(scene.objects[0]);
    sides.add_objects(scene);
    EXPECT_TRUE(sides.is_inside(ObjectId(0), 2, false));
    EXPECT_FALSE(sides.is_inside(ObjectId(2), 2, false));
    sides.mark(ObjectId(2), 2, true);
    EXPECT_TRUE(sides.is_inside(ObjectId(2), 2, false));
}

}  // namespace
}  // namespace chiaro
