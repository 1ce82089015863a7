// From an animation and a time to edits.
#pragma once

#include "scene/edit.h"

#include <vector>

namespace chiaro {

/// What puts all that hangs on animated nodes, or below them, in its place at `seconds`, which
/// starts again from 0 at the animation's end: SetTransform of objects, SetLight of lights (what
/// else they are stays as it is in `scene`), and SetCamera of cameras, each under its name: apply
/// that of the camera that is looked through. An object scaled to nothing or thrown beyond 1e9
/// stays where it was.
std::vector<Edit> animate(const Scene& scene, const Animation& animation, double seconds);

/// Puts a camera, a light in the place of its node: both look along its -z, cameras with +y
/// upwards; no scale reaches them. False, and nothing is changed, where the transform leaves them
/// no direction.
bool place_camera(const Mat4& to_world, Camera& camera);
bool place_light(const Mat4& to_world, PunctualLight& light);

}  // namespace chiaro
