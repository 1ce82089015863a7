// Limits the cache's size (3.1): children that nobody looks at are deleted.
#pragma once

#include "shading_cache/shading_cache.h"

namespace chiaro {

struct AgingSettings {
    std::size_t budget_bytes = std::size_t{2} << 30;
    Cycle unseen_cycles = 100;  // children not seen for longer may go
};

/// Does nothing while the cache is within its budget. Above it, deletes all children of a patch if
/// (a) none of them was seen in `unseen_cycles`, or (b) the patch covers less than one pixel,
/// as 3.1 says, and packs the rest. Returns whether ids changed: fragments must then be attached
/// anew.
bool age_out(ShadingCache& cache, const AgingSettings& settings, Cycle now);

}  // namespace chiaro
