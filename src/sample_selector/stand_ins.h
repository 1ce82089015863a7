// Vertices of meshes that nobody sees, although they speak for some that are seen.
#pragma once

#include "sample_selector/mesh_front.h"

namespace chiaro {

/// Lets every vertex of the front that is not in view itself, and not evaluated, be sampled where
/// the vertex in view is that it speaks for most (ShadingCache::stand_in): floors go on under
/// furniture and walls behind it and out of the room, where it is dark.
void sample_hidden_in_view(ShadingCache& cache, const MeshFront& front);

}  // namespace chiaro
