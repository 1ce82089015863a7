// Shading between the vertices of a leaf.
#pragma once

#include "shading_cache/fade_in.h"

namespace chiaro {

/// Irradiance of all channels at a local point of `leaf` [lux a colour channel], or glossy radiance
/// toward the eye [cd/m2 a colour channel], as last resolved.
///
/// A leaf is a fan of triangles round its centre, whose value is the mean of the corners. Where
/// neighbours have put midpoints on an edge the fan has a triangle for each part, so that both
/// sides of an edge agree at every point of it: no cracks in shading at T-junctions. Hollow
/// vertices are left out and the other weights scaled up; black if all are hollow. With `fade`, as
/// far as that has come.
Rgb irradiance_at(const ShadingCache& cache, PatchId leaf, Vec2 local,
                  const FadeIn* fade = nullptr);
Rgb glossy_at(const ShadingCache& cache, PatchId leaf, Vec2 local, const FadeIn* fade = nullptr);

/// Where a local point lies in the fan: the leaf's edge from corner `edge` to the next, and the
/// weights of the centre and the edge's two ends (sum 1).
struct FanPlace {
    int edge;
    float centre, a, b;
};
FanPlace fan_place(bool quad, Vec2 local);

}  // namespace chiaro
