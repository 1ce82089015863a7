// From rows of what rays saw to a map on root patches.
#pragma once

#include "image_generator/view_fragments.h"

#include <span>

namespace chiaro {

/// Puts what was seen on root patches, made if new, in the order of pixels. Of pixels that their
/// rows did not look at the map has what `before` has, which is on roots too; null if there are
/// none.
IdMap put_on_roots(ShadingCache& cache, std::span<const SeenRow> rows, const Viewing& viewing,
                   const IdMap* before, int threads);

/// Marks what was seen, but by chance: what polish shows proves nothing, as its rays leave in all
/// directions from just above a surface, and where another one rises out of it, just above may be
/// inside of that.
void mark_open_sides(OpenSides& open_sides, std::span<const SeenRow> rows);

}  // namespace chiaro
