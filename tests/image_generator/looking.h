// Scenes to look at, and what a picture's pixels are made of.
#pragma once

#include "image_generator/ray_view.h"
#include "sample_renderer/tiny_scenes.h"

#include <utility>

namespace chiaro::tiny {

/// A scene with a view of it. The camera stands at (0, 0, 4) and looks along -z; a pixel of a
/// picture `height` high is 8 tan(fov / 2) / height wide in the plane z = 0, that is 8 / height.
struct Looking {
    Scene scene;
    RayCaster caster;
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache;
    View view;

    Looking(Scene s, int width, int height, Vec3 eye = {0, 0, 4}, Vec3 target = Vec3(0))
        : scene(std::move(s)),
          caster(scene, 1),
          cache(scene, graphs, {1}, SplitRule::by_shape),
          view({.eye = eye, .target = target, .vertical_fov = 90}, width, height) {}
    Looking(const Looking&) = delete;
    Looking& operator=(const Looking&) = delete;

    IdMap map(Aov aov, int threads = 1) {
        RayViewSettings settings;
        settings.aov = aov;
        settings.threads = threads;
        return make_id_map(cache, caster, view, settings, nullptr);
    }
};

/// Reflectances of a pixel's fragments; in an irradiance map the part of the pixel that is covered.
inline Rgb covered(const IdMap& map, int x, int y) {
    Rgb sum(0);
    for (const Fragment& f : map.at_pixel(static_cast<std::uint32_t>(y * map.width + x)))
        sum += f.reflectance;
    return sum;
}

/// A wall in the plane z = `z` from x = `left` to `right` and y = `low` to `high`, front toward the
/// camera.
inline ObjectId add_wall(Scene& scene, float z, float left, float right, MaterialId material,
                         float low = -50, float high = 41.7f) {
    return add_quad(scene, {left, low, z}, {right - left, 0, 0}, {0, high - low, 0}, material);
}

}  // namespace chiaro::tiny
