// A nine-foot pool table and what is played with on it, in metres.
#pragma once

#include "scene/hall_materials.h"

namespace chiaro {

/// Half the playing field between the cushions' noses, 1.27 x 2.54, and the height of its cloth.
inline constexpr Vec2 kHalfField(0.635f, 1.27f);  // across x and along z
inline constexpr float kClothHeight = 0.76f;
inline constexpr float kRailHeight = 0.805f;

/// Stands on y = 0 about the origin, with six pockets.
Mesh pool_table(const HallPalette& palette);

/// Upright on y = 0, 1.47 long.
Mesh cue(const HallPalette& palette);

/// The triangle that balls are racked with, lying on y = 0.
Mesh ball_rack(const HallPalette& palette);

/// A cube of chalk in its paper, worn hollow, standing on y = 0.
Mesh chalk(const HallPalette& palette);

}  // namespace chiaro
