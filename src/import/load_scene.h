// Scenes from files: glTF 2.0 (.gltf, .glb) and Wavefront OBJ with MTL (.obj). docs/files.md says
// what is read of each.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <optional>

namespace chiaro {

struct LoadOptions {
    /// The file's vertical axis, of any length; absent: +y. The geometry is not turned.
    std::optional<Vec3> up = std::nullopt;
    /// Multiplies all lengths; above 0 and finite. Light keeps its candela and lux.
    float scale = 1;
};

/// Reads the scene in `file`, by its ending. The result has passed check_scene(), its names are
/// unique among objects, materials, lights and cameras each, and its `warnings` say what was left
/// out. Throws an Error of one line, `file: where: what`, for whatever is wrong with the file.
Scene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace chiaro
