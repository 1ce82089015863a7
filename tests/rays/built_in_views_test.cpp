// What the cameras of the built-in scenes see, where they stand and on their paths.
#include "rays/casting.h"
#include "scene/built_in.h"
#include "scene/built_in_paths.h"

#include <gtest/gtest.h>

#include <set>

namespace chiaro {
namespace {

// Several objects, none of them right before the lens.
void expect_view(const Scene& scene, const RayCaster& caster, const Camera& camera) {
    constexpr int kWidth = 32, kHeight = 24;
    const View view(camera, kWidth, kHeight);
    std::set<ObjectId> seen;
    for (int k = 0; k < kWidth * kHeight; ++k) {
        const Ray ray =
            view.ray(static_cast<float>(k % kWidth) + 0.5f, static_cast<float>(k / kWidth) + 0.5f);
        const Hit hit = tiny::cast(caster, ray);
        if (!hit) continue;
        seen.insert(hit.point.object);
        EXPECT_GT(hit.t, 0.15f) << camera.name << " "
                                << scene.objects[index_of(hit.point.object)].name;
    }
    EXPECT_GE(seen.size(), 5u) << camera.name;
}

TEST(BuiltInViews, EveryCameraSeesSomething) {
    for (const std::string& name : built_in_names()) {
        const Scene scene = *built_in_scene(name);
        const RayCaster caster(scene, 1);
        for (const Camera& camera : scene.cameras) expect_view(scene, caster, camera);
        const auto paths = built_in_paths(name);
        if (!paths) continue;
        for (const CameraKey& key : paths->camera)
            expect_view(scene, caster,
                        {.name = name + " at " + std::to_string(key.time),
                         .eye = key.eye,
                         .target = key.target,
                         .vertical_fov = scene.cameras[0].vertical_fov});
    }
}

}  // namespace
}  // namespace chiaro
