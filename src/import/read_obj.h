// Wavefront OBJ: polygons, bicubic surfaces, groups and materials.
#pragma once

#include "import/scene_file.h"
#include "scene/scene.h"

namespace chiaro {

/// The scene in an OBJ file and the MTL files that it names. One object for each combination of `o`
/// and `g`. Its polygons are cages of Catmull-Clark surfaces if the file has subdivision tags, or
/// if `subdivide` says so. Throws an Error at `file:line`.
Scene read_obj(const SceneFile& file, bool subdivide);

}  // namespace chiaro
