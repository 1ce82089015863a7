// Solids of revolution as rational bicubic patches, exact where they are of circles.
#pragma once

#include "scene/bicubic.h"
#include "scene/scene.h"

#include <span>
#include <vector>

namespace chiaro {

/// Curves of a profile in the (radius, height) half plane, as lathe() has them: outside lies on
/// their right as they run.
CubicCurve line_curve(Vec2 from, Vec2 to);
CubicCurve bezier_curve(Vec2 a, Vec2 b, Vec2 c, Vec2 d);
/// Part of a circle, at most 90 degrees of it; angles in degrees from the radius axis.
CubicCurve arc_curve(Vec2 centre, float radius, float from, float to);

/// A smooth curve through the points of a lathe()'s profile: a point given twice is a sharp edge,
/// two points between edges are joined straight, and the axis is met at a right angle.
std::vector<CubicCurve> smooth_profile(std::span<const Vec2> points);

/// The profile turned about the y axis, four patches for each curve. Texture coordinates: turns,
/// and curves counted along the profile.
Mesh revolve(std::span<const CubicCurve> profile);

/// About the origin.
Mesh curved_sphere(float radius);

}  // namespace chiaro
