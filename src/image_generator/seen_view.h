// A view of one ray a pixel that is seen again only where something moved.
#pragma once

#include "image_generator/ray_view.h"
#include "image_generator/sight_line.h"

#include <span>

namespace chiaro {

/// What one ray a pixel saw of a view, and where the rays went: about 130 bytes a pixel, and more
/// where mirrors, glass and polish show.
struct SeenView {
    IdMap map;                                  // on root patches, not attached
    std::vector<std::vector<SightLine>> lines;  // by row
};

/// As make_id_map() with one ray a pixel.
SeenView see_view(ShadingCache& cache, const RayCaster& rays, const View& view,
                  const RayViewSettings& settings, OpenSides* open_sides);

/// Sees those pixels again of which a ray goes through one of the boxes (world space). The same as
/// see_view() of the scene as it is by now, if all that rays may see otherwise lies in the boxes,
/// and lay there before; glints of other pixels keep the light that they have. The view and the
/// settings are those of before. Returns how many pixels were seen again.
std::size_t see_changes(SeenView& seen, ShadingCache& cache, const RayCaster& rays,
                        const View& view, const RayViewSettings& settings, OpenSides* open_sides,
                        std::span<const Box> boxes);

}  // namespace chiaro
