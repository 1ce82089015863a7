// Pool balls: exact spheres with their numbers painted on.
#pragma once

#include "scene/scene.h"

namespace chiaro {

inline constexpr float kBallRadius = 0.028575f;  // metres

/// A ball about the origin, its number on the sides towards +x and -x; 0 is the cue ball, 1 to 7
/// are solids, 8 is black, 9 to 15 are stripes. Adds its material and texture to the scene.
Mesh pool_ball(Scene& scene, int number);

}  // namespace chiaro
