// Scenes of any size for measuring rays: a furnished box of quads, lit by one area light.
#pragma once

#include "scene/scene.h"

namespace chiaro {

/// A closed room of 6 x 3 x 5 metres with boxes and faceted spheres in it, half of each, about
/// `quads` quads in all; every thing is an object with a mesh of its own. Lambertian surfaces of
/// albedo 0.3 to 0.8 without textures.
Scene make_furnished_box(int quads);

}  // namespace chiaro
