// The rails of a pool table: wood, cushions, and the pockets between them.
#pragma once

#include "scene/hall_materials.h"

namespace chiaro {

/// Round a field of half the size `half`; y = 0 is the cloth.
void add_rails(Mesh& mesh, const HallPalette& palette, Vec2 half, const Mat4& placement);

}  // namespace chiaro
