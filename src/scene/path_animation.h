// The walks through the built-in scenes as animations.
#pragma once

#include "scene/built_in_paths.h"
#include "scene/scene.h"

namespace chiaro {

/// Adds the animation "path" and the nodes that it needs: the object of `paths` goes its way, and
/// the scene's first camera its own. Checks: the scene has both.
void add_path_animation(Scene& scene, const BuiltInPaths& paths);

}  // namespace chiaro
