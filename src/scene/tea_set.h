// A tea set of bicubic patches. Each mesh is in metres and stands on y = 0, its axis in x = z = 0.
#pragma once

#include "scene/scene.h"

namespace chiaro {

/// The teapot of M. Newell, "The Utilization of Procedure Models in Digital Image Synthesis", 1975;
/// its spout points along +x.
Mesh teapot(MaterialId material);
Mesh teacup(MaterialId material);  // 66 mm high, its handle along +x
Mesh saucer(MaterialId material);
inline constexpr float kSaucerWell = 0.0058f;  // where a cup stands on it
Mesh teaspoon(MaterialId material);            // lies along x, its bowl at +x

}  // namespace chiaro
