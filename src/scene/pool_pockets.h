// The pockets of a pool table, in frames whose x axis points outward from the cushions' noses at
// x = 0 and whose y = 0 is the cloth. At a corner z points outward too.
#pragma once

#include "scene/hall_materials.h"

namespace chiaro {

// From the corner of the field, or the middle of a side pocket, to the end of a nose; and how much
// longer cushions are at their backs. They end at 142 degrees at corners, and at 104 at sides.
inline constexpr float kCornerMouth = 0.084f, kCornerJaw = 0.064f;
inline constexpr float kSideMouth = 0.066f, kSideJaw = 0.0125f;

/// How far along the noses a pocket's casting takes the place of wood.
inline constexpr float kPlate = 0.022f;

/// Adds a pocket with its bag, its casting and the cloth round it: kClothUnder beyond the noses,
/// and inside of them as far as the bed leaves it out.
void add_corner_pocket(Mesh& mesh, const HallPalette& palette, const Mat4& placement);
void add_side_pocket(Mesh& mesh, const HallPalette& palette, const Mat4& placement);
inline constexpr float kClothUnder = 0.03f;
inline constexpr float kCornerCut = 0.1f;     // a square
inline constexpr Vec2 kSideCut(0.05f, 0.1f);  // across, and half of it along

}  // namespace chiaro
