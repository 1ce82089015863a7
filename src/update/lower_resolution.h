// Lower resolution where shading changes (5.3).
#pragma once

#include "shading_cache/shading_cache.h"

#include <span>

namespace chiaro {

/// "The number of patches that need to be re-computed" is limited: of a channel's stale vertices
/// in view that lie on objects which are `changing` (by ObjectId, not 0), those that speak for the
/// most pixels stay, at most `most`; the others, and those out of view, are forgotten, and patches
/// that they refined are refined no longer. Does nothing if there are no more than that. Patches
/// have the pixels of the view that was attached last. Returns how many were forgotten.
std::size_t lower_resolution(ShadingCache& cache, int channel, std::span<const char> changing,
                             std::size_t most);

}  // namespace chiaro
