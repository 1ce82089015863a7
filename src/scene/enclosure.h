// Whether a material is the surface of solids or of sheets, which decides how glass bends light.
#pragma once

#include "scene/scene.h"

namespace chiaro {

/// True if the primitives of that material in the mesh enclose a volume, their fronts outward: each
/// edge has a face on either side, joined by places and not by indices, since points are split
/// where normals or texture coordinates jump. False if there are none.
bool encloses_volume(const Mesh& mesh, MaterialId material);

/// Sets Gloss::thin of each material that transmits, for files that do not say: false where it
/// encloses a volume in every mesh that has it.
void decide_thin(Scene& scene);

}  // namespace chiaro
