// Rational bicubic Bezier patches: places, tangents and normals at (u, v), and their parts.
#pragma once

#include "base/vec.h"

#include <array>

namespace chiaro {

/// Control points of a cubic Bezier curve and of a bicubic patch, homogeneous: (w x, w y, w z, w)
/// with w > 0. Polynomial where all w are 1; others make circles, spheres and cylinders exact
/// (Piegl and Tiller, "The NURBS Book", 2nd ed., chapter 7).
using CubicCurve = std::array<Vec4, 4>;

/// `points[4 j + i]`, i along u and j along v. An edge may be collapsed into one place (a pole).
struct BicubicPatch {
    std::array<Vec4, 16> points;

    Vec4& at(int i, int j) { return points[4 * j + i]; }
    const Vec4& at(int i, int j) const { return points[4 * j + i]; }
    /// Where a control point stands in space.
    Vec3 place(int i, int j) const { return Vec3(at(i, j)) / at(i, j).w; }
};

/// A polynomial patch, of all weights 1.
BicubicPatch make_bicubic(const std::array<Vec3, 16>& points);

/// A place on a patch, and how it moves with u and with v.
struct PatchPoint {
    Vec3 position, du, dv;
};
PatchPoint patch_point(const BicubicPatch& patch, Vec2 uv);
Vec3 patch_position(const BicubicPatch& patch, Vec2 uv);

/// Along du x dv, unit; at poles, where that vanishes, its limit from the patch's middle.
Vec3 patch_normal(const BicubicPatch& patch, Vec2 uv);

/// The patch moved, turned and scaled: `affine` applied to its points.
BicubicPatch transformed(const BicubicPatch& patch, const Mat4& affine);
/// The same surface, u and v exchanged, so that its other side is the front.
BicubicPatch flipped(const BicubicPatch& patch);
/// The halves of smaller and larger u, or v (de Casteljau).
std::array<BicubicPatch, 2> halves_in_u(const BicubicPatch& patch);
std::array<BicubicPatch, 2> halves_in_v(const BicubicPatch& patch);

/// The patch's boundary from corner `side` to the next: corners stand at (0, 0), (1, 0), (1, 1) and
/// (0, 1).
CubicCurve patch_edge(const BicubicPatch& patch, int side);
Vec3 curve_position(const CubicCurve& curve, float t);
/// The same curve from its other end.
CubicCurve reversed(const CubicCurve& curve);
/// Holds the curve.
Box hull(const CubicCurve& curve);
Box hull(const BicubicPatch& patch);

/// (u, v) of a corner, 0 to 3.
inline Vec2 patch_corner(int corner) {
    return {corner == 1 || corner == 2 ? 1.0f : 0.0f, corner >= 2 ? 1.0f : 0.0f};
}

}  // namespace chiaro
