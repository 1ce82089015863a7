// Vertices of meshes that nobody sees, although they speak for some that are seen.
#pragma once

#include "sample_selector/mesh_front.h"

namespace chiaro {

/// Samples every vertex of the front that is a corner of no root, and not evaluated, where a vertex
/// in view is that it speaks for: the one of which the largest part hangs on it along one path of
/// parents (ShadingCache::relocate). Floors go on under furniture and out of the room, and walls
/// behind it, where it is dark. Where light falls off steeply the picture is a little worse for it
/// at first, as weights are made for the vertex's own place.
void relocate_hidden(ShadingCache& cache, const MeshFront& front);

}  // namespace chiaro
