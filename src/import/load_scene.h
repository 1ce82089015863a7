// Scenes from files: glTF 2.0 (.gltf, .glb), Wavefront OBJ with MTL (.obj) and Bezier patches
// (.bpt). docs/files.md says what is read of each.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <optional>

namespace chiaro {

/// The largest coordinate of anything [scene units]. Choosing among lights takes squares of squares
/// of distances, which are no floats beyond about four times this.
inline constexpr float kFarthest = 1e9f;
inline bool within_reach(Vec3 p) {
    const Vec3 size = glm::abs(p);
    return size.x <= kFarthest && size.y <= kFarthest && size.z <= kFarthest;
}

/// The brightest light a channel [cd/m2, cd, lux]: variances are squares, with room for what a
/// light near by adds.
inline constexpr float kBrightest = 1e15f;

struct LoadOptions {
    /// The file's vertical axis, of any length; absent: +y. The geometry is not turned.
    std::optional<Vec3> up = std::nullopt;
    /// Multiplies all lengths; above 0 and finite. Light keeps its candela and lux.
    float scale = 1;
    /// Polygons are cages of Catmull-Clark surfaces, and become bicubic patches.
    bool subdivide = false;
};

/// Reads the scene in `file`, by its ending. The result has passed check_scene(), its names are
/// unique among objects, materials, lights and cameras each, and its `warnings` say what was left
/// out. Throws an Error of one line, `file: where: what`, for whatever is wrong with the file.
Scene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace chiaro
