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

/// The scene called `name`, or nothing if there is none. Passes check_scene().
///   room     a furnished living room of about 4000 primitives, metres, lit by a ceiling panel, 9
///   of its objects curved cornell  the Cornell box as it was measured, one unit a hundredth of the
///   published one
std::optional<Scene> built_in_scene(std::string_view name);

/// The scenes themselves.
Scene make_room();
Scene make_cornell_box();

}  // namespace chiaro
