// Wavefront OBJ: polygons, groups and materials.
#pragma once

#include "import/scene_file.h"
#include "scene/scene.h"

namespace chiaro {

/// The scene in an OBJ file and the MTL files that it names. One object for each combination of `o`
/// and `g`. Throws an Error at `file:line`.
Scene read_obj(const SceneFile& file);

}  // namespace chiaro
