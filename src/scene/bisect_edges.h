// A scene's surfaces in smaller triangles: dense meshes that look as the plain ones do.
#pragma once

#include "scene/scene.h"

namespace chiaro {

/// Halves edges until none is longer than `longest` in world space, under any object that shows the
/// mesh [scene units]. Surfaces stay where they are. Of quads with a long side or diagonal two
/// triangles are made first, along the diagonal where their halves meet.
///
/// Of a triangle the longest edge is halved first. Whether an edge is halved depends on its ends
/// alone, so that all who have it agree: no cracks, no corner in the middle of a neighbour's edge.
/// Points made on an edge are shared where its ends are. What points carry is interpolated; normals
/// are made of unit length again. An edge stays whose middle is one of its ends, and slivers that
/// rounding has made flat are dropped (order_primitives). Bicubic patches stay as they are.
///
/// Checks: `longest` > 0; fewer than 2^32 points of a mesh come out.
void bisect_edges(Scene& scene, float longest);

}  // namespace chiaro
