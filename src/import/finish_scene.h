// The last steps of every import, whatever the file.
#pragma once

#include "import/load_scene.h"

#include <string>

namespace chiaro {

/// Applies `options`; orders primitives; leaves out objects without surface and meshes without
/// objects; refuses a world that floats cannot hold. Afterwards check_scene() holds.
void finish_scene(Scene& scene, const LoadOptions& options, const std::string& where);

}  // namespace chiaro
