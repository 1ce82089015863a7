#include "shading_cache/age_out.h"

#include <algorithm>

namespace chiaro {
namespace {

// Children in view were marked when the view was attached or they were made; `now` goes on while
// the view rests, so a patch that has fragments counts as seen now.
bool recently_seen(const Patch& child, Cycle unseen_cycles, Cycle now) {
    return child.fragment_count > 0 || now - child.last_seen <= unseen_cycles;
}

bool useless(const ShadingCache& cache, const Patch& patch, const AgingSettings& settings,
             Cycle now) {
    if (patch.is_leaf()) return false;
    bool any_seen = false;
    for (int c = 0; c < child_count(patch.split); ++c)
        any_seen |= recently_seen(cache.patch(offset_by(patch.first_child, c)),
                                  settings.unseen_cycles, now);
    return !any_seen || patch.fragment_count == 1;
}

}  // namespace

bool age_out(ShadingCache& cache, const AgingSettings& settings, Cycle now) {
    if (cache.bytes() <= settings.budget_bytes) return false;
    bool collapsed = false;
    for (std::size_t i = 0; i < cache.patches().size(); ++i) {
        if (!useless(cache, cache.patches()[i], settings, now)) continue;
        cache.collapse(static_cast<PatchId>(i));
        collapsed = true;
    }
    if (collapsed) cache.pack();
    return collapsed;
}

}  // namespace chiaro
