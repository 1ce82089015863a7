// From the command line's words to a scene and a view of it.
#pragma once

#include "apps/options.h"
#include "scene/scene.h"

namespace chiaro {

/// The scene that the options name, in the environment that they name. Prints its warnings to
/// standard error, a line each.
Scene open_scene(const Options& options);

/// The camera that the options ask for: a named or numbered one, or one from --eye, else the
/// scene's first, else one from inside its bounds. Further options change it.
Camera choose_camera(const Scene& scene, const Options& options);

/// Makes all edits of the script that the options name, in the order of their times, before
/// anything looks at the scene. `camera` is the one that they change.
void apply_edits(Scene& scene, Camera& camera, const Options& options);
/// For commands that look through none.
void apply_edits(Scene& scene, const Options& options);

/// Gives a scene without lights a lamp at the eye, with a warning.
void add_headlamp_if_dark(Scene& scene, const Camera& camera);

}  // namespace chiaro
