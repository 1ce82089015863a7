// A view of one ray a pixel that is seen again only where something moved.
#include "image_generator/seen_view.h"

#include "image_generator/looking.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

using namespace tiny;

constexpr int kSize = 60;

// A small box before a mirror, beside a polished wall and behind a pane.
struct Stand {
    ObjectId box{};
    Looking looking;
    OpenSides open_sides;

    Stand() : looking(furnished(box), kSize, kSize), open_sides(looking.scene) {}

    static Scene furnished(ObjectId& box) {
        Scene scene;
        add_room(scene, Vec3(-9), Vec3(9), add_material(scene, Rgb(0.5f), Rgb(1)));
        add_wall(scene, -2, -4, 0, add_glossy(scene, Rgb(1), mirror(Rgb(1))), -3, 3);
        add_wall(scene, -2, 0.5f, 4, add_glossy(scene, Rgb(1), metal(0.2f)), -3, 3);
        add_wall(scene, 2, -1, 0, add_glossy(scene, Rgb(1), glass(0, true)), -1, 1);
        box = static_cast<ObjectId>(scene.objects.size());
        add_box(scene, Vec3(-0.2f), Vec3(0.2f), add_material(scene, Rgb(0.3f)));
        return scene;
    }
    Object& object() { return looking.scene.objects[index_of(box)]; }
    Box place() { return bounds(looking.scene.mesh_of(object()), object().to_world); }
    // Moves the box, and tells where it was and is.
    std::vector<Box> move(Vec3 by) {
        std::vector<Box> boxes = {place()};
        object().to_world = glm::translate(object().to_world, by);
        looking.caster.set_transform(box);
        boxes.push_back(place());
        return boxes;
    }
    SeenView see() {
        return see_view(looking.cache, looking.caster, looking.view, {}, &open_sides);
    }
};

void expect_same(const IdMap& map, const IdMap& other) {
    ASSERT_EQ(map.first_of_pixel, other.first_of_pixel);
    ASSERT_EQ(map.fragments.size(), other.fragments.size());
    for (std::size_t i = 0; i < map.fragments.size(); ++i) {
        const Fragment &a = map.fragments[i], &b = other.fragments[i];
        ASSERT_EQ(a.pixel, b.pixel);
        ASSERT_EQ(a.patch, b.patch) << "pixel " << a.pixel;
        ASSERT_EQ(a.local, b.local) << "pixel " << a.pixel;
        ASSERT_EQ(a.reflectance, b.reflectance) << "pixel " << a.pixel;
    }
    ASSERT_EQ(map.glints.size(), other.glints.size());
    for (std::size_t i = 0; i < map.glints.size(); ++i) {
        ASSERT_EQ(map.glints[i].pixel, other.glints[i].pixel);
        ASSERT_EQ(map.glints[i].weight, other.glints[i].weight);
    }
    ASSERT_EQ(map.chance_pixels.size(), other.chance_pixels.size());
    for (std::size_t i = 0; i < map.chance_pixels.size(); ++i) {
        ASSERT_EQ(map.chance_pixels[i].pixel, other.chance_pixels[i].pixel);
        ASSERT_EQ(map.chance_pixels[i].steady_background, other.chance_pixels[i].steady_background);
    }
    for (std::size_t i = 0; i < map.background.pixels.size(); ++i)
        ASSERT_EQ(map.background.pixels[i], other.background.pixels[i]) << "pixel " << i;
}

// However often a box moves, what is seen again where it was and is makes the map that all rays
// would make: straight, in mirrors, by chance in polish and through panes.
TEST(SeenView, WhatIsSeenAgainIsTheWholeMap) {
    Stand stand;
    SeenView seen = stand.see();
    for (const Vec3 by : {Vec3(0.5f, 0.1f, 0), Vec3(-1.2f, 0, 0.5f), Vec3(0.3f, 0.8f, -1)}) {
        const std::vector<Box> boxes = stand.move(by);
        Looking& l = stand.looking;
        const std::size_t again =
            see_changes(seen, l.cache, l.caster, l.view, {}, &stand.open_sides, boxes);
        EXPECT_GT(again, 10u);
        EXPECT_LT(again, kSize * kSize / 2u);
        expect_same(seen.map, stand.see().map);
    }
}

// Where nothing moved, no pixel is seen again.
TEST(SeenView, NothingIsSeenAgainWhereNothingMoved) {
    Stand stand;
    SeenView seen = stand.see();
    Looking& l = stand.looking;
    EXPECT_EQ(see_changes(seen, l.cache, l.caster, l.view, {}, nullptr, {}), 0u);
    expect_same(seen.map, stand.see().map);
}

}  // namespace
}  // namespace chiaro
