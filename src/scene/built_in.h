// Scenes that need no file: what `builtin:NAME` on the command line shows.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chiaro {

/// Names that built_in_scene() knows, in the order in which to list them.
std::vector<std::string> built_in_names();

/// The scene called `name`, or nothing if there is none. Passes check_scene(). All are in metres
/// but `cornell`, and have their first camera for a default view.
///   room      a living room of about 4000 primitives and 9 curved objects under a luminous panel
///   indirect  a gallery of about 300 primitives, lit by a panel behind a wall: hardly any of the
///             light in its cameras' views is direct
///   poolhall  a pool hall of about 10,000 primitives with 11 point lights and 15 glossy, curved
///             balls
///   cornell   the Cornell box as it was measured, one unit a hundredth of the published one
std::optional<Scene> built_in_scene(std::string_view name);

/// The scenes themselves.
Scene make_room();
Scene make_indirect();
Scene make_poolhall();
Scene make_cornell_box();

}  // namespace chiaro
