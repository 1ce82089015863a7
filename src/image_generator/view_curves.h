// Bicubic patches divided as finely as a view's pixels need (3.3): the display's geometry, whose
// shading is looked up in the cache and never made for its own sake.
#pragma once

#include "rays/ray_caster.h"
#include "scene/camera.h"

namespace chiaro {

/// Shows `view` the curved surfaces in it so that their outlines are within a quarter of a pixel of
/// the truth, and no farther than other rays see them: down to a hundredth of what these see, in up
/// to 2 million points an object. Returns the triangles that it took; none where those of other
/// rays will do. Objects that move afterwards keep theirs until the next call. Not while others
/// cast.
std::size_t show_curves(RayCaster& rays, const View& view, int threads);

}  // namespace chiaro
