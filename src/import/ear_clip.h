// Polygons as files have them, of any number of corners, into the quads and triangles of a mesh.
#pragma once

#include "base/vec.h"
#include "scene/scene.h"

#include <span>
#include <vector>

namespace chiaro {

/// The largest polygon that is not convex, in corners.
inline constexpr std::size_t kMaxConcaveCorners = 20000;

/// A piece of a polygon: positions in its list of corners, the fourth Primitive::kNoCorner on a
/// triangle.
using PolygonPiece = std::array<std::uint32_t, 4>;

/// Covers the polygon through `corners` (at least 3) with pieces of the same winding: a convex and
/// nearly flat quad stays one piece, a convex polygon becomes quads and at most one triangle, any
/// other is ear-clipped into triangles. A polygon that crosses itself or has no area gets some
/// pieces too; one that runs round the same loop several times counts once. False, and no pieces,
/// if it is not convex and has more than kMaxConcaveCorners.
bool split_polygon(std::span<const Vec3> corners, std::vector<PolygonPiece>& pieces);

}  // namespace chiaro
