// Simple solids that furniture is put together from. Every function returns a mesh in metres, y up,
// whose faces look outward, with normals and one set of texture coordinates (metres on the face);
// its material is set when the shape is added to a piece of furniture.
#pragma once

#include "scene/scene.h"

#include <functional>
#include <span>
#include <vector>

namespace chiaro {

/// Faces of a box, as bits.
enum Face : unsigned {
    kLeft = 1,    // -x
    kRight = 2,   // +x
    kBottom = 4,  // -y
    kTop = 8,     // +y
    kBack = 16,   // -z
    kFront = 32,  // +z
    kAllFaces = 63,
};

/// Adds `part`, moved by `placement` (a rigid motion and a uniform scale), to `mesh`.
void add(Mesh& mesh, const Mesh& part, MaterialId material, const Mat4& placement = Mat4(1));

/// A flat quadrilateral, counter-clockwise from its front.
Mesh quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d);

/// A box without the faces `left_out`. Leave out what rests on another surface: two faces in one
/// place fight, and the surface below a solid with an open bottom sees that it is covered.
Mesh box(Vec3 low, Vec3 high, unsigned left_out = 0);

/// A box with round edges and smooth normals: cushions. 54 quads. `radius` is at most half the
/// smallest side.
Mesh rounded_box(Vec3 low, Vec3 high, float radius);

/// A solid of revolution about the y axis. `profile` holds (radius, height); where it runs upward
/// the outside is away from the axis, where it runs downward towards it (the inside of a bowl). A
/// point given twice is a sharp edge. Smooth normals round the axis.
Mesh lathe(std::span<const Vec2> profile, int sides);

/// Flat facets between rings of equally many points, each ring closed. Seen from the last ring
/// towards the first, points run counter-clockwise. No caps; `closed` also joins the last ring to
/// the first.
Mesh loft(std::span<const std::vector<Vec3>> rings, bool closed = false);

/// A straight bar from `from` to `to` with a rectangular section of `width` (across the bar and
/// `side` roughly along it) and `depth`, tapering to `taper` times that at `to`. No caps.
Mesh bar(Vec3 from, Vec3 to, Vec3 side, Vec2 width_depth, float taper = 1);

/// A profile swept round the rectangle [0, size.x] x [0, size.y] of the x-y plane with mitred
/// corners (skirting, picture frame). A profile point (inward, height) stands `inward` from the
/// rectangle towards its middle and `height` along +z; points run so that outward faces lie on
/// their right. The profile is open: the side on the wall is not made.
Mesh moulding(Vec2 size, std::span<const Vec2> profile);

/// An open sheet through point(u, v), u and v in [0, 1]; front where du x dv points. Smooth
/// normals.
Mesh sheet(int columns, int rows, const std::function<Vec3(float u, float v)>& point);

/// Rigid placements.
Mat4 moved(Vec3 by);
Mat4 turned(Vec3 axis, float degrees);

}  // namespace chiaro
