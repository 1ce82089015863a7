// Bicubic patches as grids of points whose triangles are as near to them as asked, without gaps
// between neighbours (3.3).
#pragma once

#include "scene/bicubic.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace chiaro {

/// One patch: (columns + 1) x (rows + 1) points, row by row along v, evenly spaced in u and v.
struct PatchGrid {
    std::uint32_t first = 0;  // of its points
    std::uint16_t columns = 1, rows = 1;

    std::size_t points() const { return (columns + std::size_t{1}) * (rows + std::size_t{1}); }
};
struct PatchGrids {
    std::vector<Vec3> points;      // of all patches, in the patches' space
    std::vector<PatchGrid> grids;  // by patch

    float error = 0;  // a bound on how far the triangles are off; 0 of flat patches

    std::size_t triangles() const;
};

/// How far from the surface its triangles may be, within a box in the patches' space (above 0).
/// Thread: called from several at once.
using ToleranceIn = std::function<float(const Box&)>;

/// Grids of up to 256 x 256 cells for each patch. An edge is divided by its own curve and the
/// tolerance along it alone, so that patches on both sides of it agree on its points; a grid that
/// is finer than its edge has the rest of its points there on straight lines.
///
/// Throws an Error where all together would have more than kMostGridPoints points.
PatchGrids tessellate(std::span<const BicubicPatch> patches, const ToleranceIn& tolerance,
                      int threads);
inline constexpr std::size_t kMostGridPoints = std::size_t{1} << 27;

/// How many points that would have.
std::size_t grid_points(std::span<const BicubicPatch> patches, const ToleranceIn& tolerance,
                        int threads);

}  // namespace chiaro
