#include "scene/path_animation.h"

#include "scene/animate.h"
#include "scene/built_in.h"
#include "scene/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chiaro {
namespace {

void expect_near(const Mat4& a, const Mat4& b) {
    for (int column = 0; column < 4; ++column) EXPECT_LT(glm::length(a[column] - b[column]), 1e-4f);
}

// At every key, the object is where the path says, and the camera looks where it says.
TEST(PathAnimation, GoesThroughTheKeysOfThePath) {
    for (const std::string& name : built_in_names()) {
        const auto paths = built_in_paths(name);
        if (!paths) continue;
        Scene scene = *built_in_scene(name);
        add_path_animation(scene, *paths);
        const Animation& animation = scene.animations.at(0);
        EXPECT_EQ(animation.name, "path");
        const auto object = std::ranges::find(scene.objects, paths->object, &Object::name);
        const Vec3 centre = bounds(scene.mesh_of(*object), object->to_world).centre();
        for (const ObjectKey& key : paths->object_keys) {
            if (key.time >= animation.duration) continue;
            const auto edits = animate(scene, animation, double(key.time));
            ASSERT_EQ(edits.size(), 2u);
            const auto& move = std::get<SetTransform>(edits[0]);
            EXPECT_EQ(&scene.objects[index_of(move.object)], &*object);
            expect_near(move.to_world, moved(key.translate + centre) *
                                           turned(key.axis, key.degrees) * moved(-centre) *
                                           object->to_world);
        }
        for (const CameraKey& key : paths->camera) {
            if (key.time >= animation.duration) continue;
            const auto edits = animate(scene, animation, double(key.time));
            const Camera& camera = std::get<SetCamera>(edits.at(1)).camera;
            EXPECT_EQ(camera.name, scene.cameras[0].name);
            EXPECT_LT(glm::distance(camera.eye, key.eye), 1e-4f);
            const Vec3 forward = glm::normalize(camera.target - camera.eye);
            EXPECT_GT(glm::dot(forward, glm::normalize(key.target - key.eye)), 0.99999f);
        }
    }
}

}  // namespace
}  // namespace chiaro
