// The pool hall's furniture and joinery, in metres; what stands, stands on y = 0 about the origin,
// its front towards +z, and what is on a wall has its back in z = 0.
#pragma once

#include "scene/hall_materials.h"

namespace chiaro {

/// Hangs about the bulb, which is the origin, on a cord of `drop` metres.
Mesh pendant(const HallPalette& palette, float drop);

Mesh bar_stool(const HallPalette& palette);
inline constexpr float kBarHeight = 1.1f;
Mesh bar_counter(const HallPalette& palette, float length);
Mesh back_bar(const HallPalette& palette, float length);  // shelves without what stands on them
inline constexpr int kBackBarShelves = 3;
float back_bar_shelf(int shelf);  // heights, from the bottom
Mesh bottle(MaterialId glass, MaterialId label, float height);

/// Panelling from the floor to kDado on a wall of `width`, from x = 0.
inline constexpr float kDado = 1.05f;
Mesh wainscot(const HallPalette& palette, float width);

/// Holds `count` cues upright, kCuePitch apart about x = 0; its lower board is kCueFoot high.
inline constexpr float kCuePitch = 0.11f, kCueFoot = 0.12f, kCueDepth = 0.07f;
Mesh cue_rack(const HallPalette& palette, int count);

}  // namespace chiaro
