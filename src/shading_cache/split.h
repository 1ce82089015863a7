// How a patch is divided (3.1): the children's places in their parent's local coordinates.
//
// Local coordinates run over one patch: on a quad (s, t) in [0, 1]^2 with corners 0 (0, 0), 1 (1,
// 0), 2 (1, 1), 3 (0, 1); on a triangle s and t are the weights of corners 1 and 2.
#pragma once

#include "base/vec.h"

#include <array>
#include <cstdint>
#include <span>

namespace chiaro {

/// The paper divides into four. Long patches are halved across instead, so that children stay near
/// square: a strip 100 times as long as wide would otherwise need 10,000 children for 100.
enum class Split : std::uint8_t {
    none,
    quad_in_four,
    quad_across_s,  // two children, cut at s = 1/2
    quad_across_t,
    triangle_in_four,
    triangle_edge_01,  // two children, the edge between corners 0 and 1 halved
    triangle_edge_12,
    triangle_edge_20,
};

/// Where children have their corners: 0 to 3 the parent's corners, 4 + e the midpoint of the
/// parent's edge from corner e to the next, 8 the centre of a quad.
using Node = std::uint8_t;
inline constexpr Node kFirstMidpoint = 4;
inline constexpr Node kCentre = 8;
inline constexpr Node kNoNode = 255;

int child_count(Split split);

/// Nodes of a child's corners, counter-clockwise as its parent's; the fourth is kNoNode on a
/// triangle.
std::span<const Node, 4> child_corners(Split split, int child);

/// The child that holds the parent's local point; on a border, one of those that share it.
int child_at(Split split, Vec2 local);

/// From a parent's local coordinates to a child's, and back. Both are affine and exact to rounding.
Vec2 to_child(Split split, int child, Vec2 local);
Vec2 to_parent(Split split, int child, Vec2 local);

/// Local coordinates of a node.
Vec2 node_place(bool quad, Node node);

/// Where a vertex at a patch's local point is sampled: nearer to the patch's centre by 0.2 %, as on
/// the border itself half the hemisphere may lie in an adjoining wall.
Vec2 pulled_in(bool quad, Vec2 local);

}  // namespace chiaro
