// Catmull-Clark surfaces as bicubic patches, by OpenSubdiv.
#pragma once

#include "import/cage.h"

#include <string>
#include <vector>

namespace chiaro {

/// The limit surface of a cage as a mesh of bicubic patches without gaps: neighbours have the same
/// control points along their common edge. Where the surface is bicubic, one patch a face, it is
/// exact; a cage with other places is refined first (docs/files.md says how near that comes).
/// Warns of faces that are left out; throws an Error at `where` if the cage is too large.
Mesh subdivide(Cage cage, const std::string& where, std::vector<std::string>& warnings);

/// Takes the polygons of all meshes that have no patches as cages.
void subdivide_meshes(Scene& scene, const std::string& where);

}  // namespace chiaro
