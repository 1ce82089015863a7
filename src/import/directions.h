// Directions of vectors of any length, and of polygons that need not be flat.
#pragma once

#include "base/vec.h"

#include <cmath>
#include <span>

namespace chiaro {

/// Unit vector along `v`, however long or short; zero where it has no direction.
inline Vec3 unit_or_zero(glm::dvec3 v) {
    const double size = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    if (!(size > 0 && size < double(kInfinity))) return Vec3(0);
    const glm::dvec3 near_unit = v / size;
    return Vec3(near_unit / glm::length(near_unit));
}

/// Twice the vector area of a polygon of at least one corner (Newell's method): along its normal,
/// and there for one that is not flat too.
inline glm::dvec3 vector_area(std::span<const Vec3> corners) {
    glm::dvec3 sum(0);
    const glm::dvec3 origin(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
    return sum;
}

}  // namespace chiaro
