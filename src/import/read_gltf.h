// glTF 2.0, as text or binary.
#pragma once

#include "import/scene_file.h"
#include "scene/scene.h"

namespace chiaro {

/// The default scene of a glTF file. Throws an Error at `file: place`, a place being written like
/// "meshes[2].primitives[0]".
Scene read_gltf(const SceneFile& file, bool binary);

}  // namespace chiaro
