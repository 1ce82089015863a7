// Light sources that are curved, as polygons.
#pragma once

#include "scene/scene.h"

#include <string>

namespace chiaro {

/// Replaces bicubic patches that emit by grids of quads, within 1/4000 of the mesh's size of them:
/// samples of light are taken on polygons. Throws an Error at `where` if that takes too many.
void flatten_emitters(Scene& scene, const std::string& where);

}  // namespace chiaro
