// Bezier patch files (.bpt), as the tea set is given in: a count, then bicubic patches one by one.
#pragma once

#include "import/scene_file.h"
#include "scene/scene.h"

#include <string>

namespace chiaro {

/// The scene in a .bpt file: one object called `name`. Throws an Error at `file:line`.
Scene read_bpt(const SceneFile& file, const std::string& name);

}  // namespace chiaro
