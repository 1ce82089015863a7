// Solids of revolution as rational bicubic patches, exact where they are of circles.
#pragma once

#include "scene/bicubic.h"
#include "scene/scene.h"

#include <span>

namespace chiaro {

/// Curves of a profile in the (radius, height) half plane, as lathe() has them: outside lies on
/// their right as they run.
CubicCurve line_curve(Vec2 from, Vec2 to);
CubicCurve bezier_curve(Vec2 a, Vec2 b, Vec2 c, Vec2 d);
/// Part of a circle, at most 90 degrees of it; angles in degrees from the radius axis.
CubicCurve arc_curve(Vec2 centre, float radius, float from, float to);

/// The profile turned about the y axis, four patches for each curve. Texture coordinates: turns,
/// and curves counted along the profile.
Mesh revolve(std::span<const CubicCurve> profile);

/// About the origin.
Mesh curved_sphere(float radius);

}  // namespace chiaro
