// Smooth flat surfaces, in which lights without extent have one image each.
#pragma once

#include "scene/surface.h"

#include <vector>

namespace chiaro {

/// A triangle, or half of a quad, that reflects as a mirror on either side.
struct FlatMirror {
    ObjectId object;
    std::uint32_t primitive;
    bool second_half;   // of a quad: the triangle (2, 3, 1)
    Vec3 corner, u, v;  // world: a place is corner + a u + b v; a, b >= 0, a + b <= 1
    Vec3 normal;        // of the front; unit

    /// The surface point at those weights.
    SurfacePoint at(float a, float b) const {
        if (second_half) return {object, primitive, 1 - a, 1 - b};
        return {object, primitive, a, b};
    }
};

/// All of a scene's whose facets are smooth and whose normals are not interpolated: metal, coats,
/// panes, bodies of glass from outside and inside.
std::vector<FlatMirror> find_flat_mirrors(const Scene& scene);

}  // namespace chiaro
