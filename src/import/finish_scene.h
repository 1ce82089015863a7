// The last steps of every import, whatever the file.
#pragma once

#include "import/load_scene.h"

#include <string>
#include <vector>

namespace chiaro {

/// Whether an object is flattened so much that the way back throws rays from within kFarthest to
/// where Embree takes none.
bool scaled_to_nothing(const Mat4& to_world);

/// Orders primitives and leaves out what shows nothing: polygons without area, objects without
/// surface or scaled to nothing, meshes without objects. Returns which materials are then in use,
/// by id: a reader gives textures to no others.
std::vector<bool> drop_unseen(Scene& scene, const std::string& where);

/// Applies `options`; refuses a world that floats cannot hold and lights that are too bright, and
/// warns of one too small. Afterwards check_scene() holds. Also for built-in scenes.
void finish_scene(Scene& scene, const LoadOptions& options, const std::string& where);

}  // namespace chiaro
