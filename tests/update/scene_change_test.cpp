// Several edits between two cycles as one change.
#include "update/scene_change.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

const Box kHere = {Vec3(0), Vec3(1)}, kThere = {Vec3(4), Vec3(5)};

// What moved counts once, with the place that it left and the one that it came to; what only shines
// otherwise is in nobody's way.
TEST(SceneChange, HoldsWhatMovedAndWhere) {
    EditEffect moved, shone;
    moved.geometry = true;
    moved.object = ObjectId{3};
    moved.before = kHere;
    moved.after = kThere;
    shone.lights = true;
    shone.object = ObjectId{5};
    shone.before = shone.after = kHere;
    const std::vector<EditEffect> effects = {moved, shone, moved};
    const SceneChange change = change_of(effects);
    EXPECT_TRUE(change.lights);
    EXPECT_TRUE(change.geometry);
    EXPECT_FALSE(change.materials);
    EXPECT_FALSE(change.passing);
    EXPECT_EQ(change.moved, std::vector<ObjectId>{ObjectId{3}});
    EXPECT_TRUE(change.has_moved(ObjectId{3}));
    EXPECT_FALSE(change.has_moved(ObjectId{5}));
    EXPECT_EQ(change.boxes.size(), 2u);
}

// Dragged in a hundred steps between two cycles, a box is where it was and where it is, and not
// between.
TEST(SceneChange, WhatIsDraggedFarIsNotBetween) {
    std::vector<EditEffect> effects;
    for (int i = 0; i < 100; ++i) {
        const Vec3 x(static_cast<float>(i), 0, 0);
        EditEffect effect;
        effect.geometry = true;
        effect.object = ObjectId{0};
        effect.before = Box{x, x + 1.0f};
        effect.after = Box{x + Vec3(1, 0, 0), x + Vec3(2, 1, 1)};
        effects.push_back(effect);
    }
    const SceneChange change = change_of(effects);
    ASSERT_EQ(change.boxes.size(), 2u);
    EXPECT_EQ(change.boxes[0].high.x, 1);
    EXPECT_EQ(change.boxes[1].low.x, 100);
}

// A hundred objects that come are one box to ask; those that move, one where they were and one
// where they are.
TEST(SceneChange, ManyBoxesAreUnited) {
    std::vector<EditEffect> effects;
    for (std::uint32_t i = 0; i < 100; ++i) {
        EditEffect effect;
        effect.geometry = true;
        effect.object = ObjectId{i};
        effect.after = Box{Vec3(static_cast<float>(i)), Vec3(static_cast<float>(i) + 1)};
        effects.push_back(effect);
    }
    const SceneChange change = change_of(effects);
    ASSERT_EQ(change.boxes.size(), 1u);
    EXPECT_EQ(change.boxes[0].low, Vec3(0));
    EXPECT_EQ(change.boxes[0].high, Vec3(100));
    EXPECT_EQ(change.moved.size(), 100u);

    for (EditEffect& effect : effects) effect.before = Box{Vec3(-9), Vec3(-8)};
    const std::vector<Box> apart = change_of(effects).boxes;
    ASSERT_EQ(apart.size(), 2u);
    EXPECT_EQ(apart[0].high, Vec3(-8));
    EXPECT_EQ(apart[1].low, Vec3(0));
}

// A camera that moves changes nothing in the scene.
TEST(SceneChange, ACameraChangesNothing) {
    EditEffect effect;
    effect.camera = true;
    EXPECT_FALSE(change_of({&effect, 1}).any());
}

// A material that lets other light through may be anywhere.
TEST(SceneChange, AMaterialMayBeAnywhere) {
    EditEffect effect;
    effect.material = MaterialId{0};
    EXPECT_TRUE(change_of({&effect, 1}).materials);
    EXPECT_FALSE(change_of({&effect, 1}).passing);
    effect.passing = true;
    EXPECT_TRUE(change_of({&effect, 1}).passing);
}

}  // namespace
}  // namespace chiaro
