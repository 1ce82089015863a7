#include "scene/built_in_paths.h"

#include "scene/built_in.h"
#include "scene/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chiaro {
namespace {

bool holds(const Box& box, Vec3 p) {
    return glm::all(glm::greaterThanEqual(p, box.low)) && glm::all(glm::lessThanEqual(p, box.high));
}

// Keys start at 0 and follow each other; the last is at 8 to 12 seconds.
template <typename Key>
void expect_times(const std::vector<Key>& keys) {
    ASSERT_GE(keys.size(), 2u);
    EXPECT_EQ(keys.front().time, 0);
    EXPECT_GE(keys.back().time, 8);
    EXPECT_LE(keys.back().time, 12);
    for (std::size_t i = 1; i < keys.size(); ++i) EXPECT_GT(keys[i].time, keys[i - 1].time);
}

Scene only(const Scene& scene, const Object& object) {
    Scene one = scene;
    one.objects = {object};
    return one;
}

TEST(BuiltInPaths, AreThoseOfThePapersScenes) {
    for (const char* name : {"room", "indirect", "poolhall"}) EXPECT_TRUE(built_in_paths(name));
    EXPECT_FALSE(built_in_paths("cornell"));
    EXPECT_FALSE(built_in_paths(""));
}

TEST(BuiltInPaths, StayInsideAndStartFromTheSceneAsItIs) {
    for (const std::string& name : built_in_names()) {
        const auto paths = built_in_paths(name);
        if (!paths) continue;
        const Scene scene = *built_in_scene(name);
        const Box inside = bounds(scene);
        expect_times(paths->camera);
        expect_times(paths->object_keys);
        EXPECT_EQ(paths->camera.front().eye, scene.cameras[0].eye) << name;
        EXPECT_EQ(paths->camera.front().target, scene.cameras[0].target) << name;
        for (const CameraKey& key : paths->camera) {
            EXPECT_TRUE(holds(inside, key.eye)) << name << " " << key.time;
            EXPECT_TRUE(holds(inside, key.target)) << name << " " << key.time;
            EXPECT_GT(glm::distance(key.eye, key.target), 0.3f) << name << " " << key.time;
        }

        const auto object = std::ranges::find(scene.objects, paths->object, &Object::name);
        ASSERT_NE(object, scene.objects.end()) << name;
        EXPECT_EQ(paths->object_keys.front().translate, Vec3(0)) << name;
        EXPECT_EQ(paths->object_keys.front().degrees, 0) << name;
        const Vec3 centre = bounds(only(scene, *object)).centre();
        for (const ObjectKey& key : paths->object_keys) {
            Object there = *object;
            there.to_world = moved(key.translate + centre) * turned(key.axis, key.degrees) *
                             moved(-centre) * object->to_world;
            const Box box = bounds(only(scene, there));
            // The hull of a turned ball's patches is a little larger than the ball.
            const Vec3 slack(0.02f);
            EXPECT_TRUE(holds(inside, box.low + slack)) << name << " " << key.time;
            EXPECT_TRUE(holds(inside, box.high - slack)) << name << " " << key.time;
        }
    }
}

}  // namespace
}  // namespace chiaro
