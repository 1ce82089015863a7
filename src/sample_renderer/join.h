// Whole paths: a walk from the eye joined to a walk from a light, to a light sample, or to a light
// that it met.
#pragma once

#include "sample_renderer/emitters.h"
#include "sample_renderer/path_vertex.h"

namespace chiaro {

/// A path whose light arrives if nothing is in the way of its last edge.
struct Join {
    Ray shadow_ray;
    Rgb value;     // that it brings to the eye's end, over the density of the way it was found in
    float weight;  // of that way among all that find this path
};

/// The ends of two walks; neither is a delta. Nothing where no light gets from one to the other.
std::optional<Join> join(const PathVertex& eye, const PathVertex& light);

/// A walk's end and a light sample, for `place`, the vertex's own or its other side.
std::optional<Join> join(const PathVertex& eye, const Receiver& place, const LightSample& light);

/// Weight of a path whose walk from the eye met the light, with this trail there.
float weight_of_met_light(const Trail& trail, const MetLight& light);

}  // namespace chiaro
