// Lower resolution where shading changes (5.3).
#pragma once

#include "shading_cache/shading_cache.h"

#include <span>

namespace chiaro {

/// "The number of patches that need to be re-computed" is limited. What is stale of a channel on
/// objects which are `changing` (by ObjectId, not 0) is forgotten; of these vertices the `most`
/// that speak for the most pixels, in the view that was attached last, are to be evaluated anew,
/// and patches that others refined are refined no longer. Of those that are drawn even so, as
/// corners of patches that nothing can make coarser, `rest` tells. Returns how many were forgotten.
enum class Rest {
    too,   // are forgotten too, whatever that takes
    waits  // show what they showed, until it is their turn
};
std::size_t lower_resolution(ShadingCache& cache, int channel, std::span<const char> changing,
                             std::size_t most, Rest rest = Rest::too);

}  // namespace chiaro
