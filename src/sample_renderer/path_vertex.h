// One vertex of a walk from the eye or from a light, as a value, and what may be asked of it.
#pragma once

#include "sample_renderer/mis_weight.h"
#include "sample_renderer/path_bounce.h"
#include "scene/scattering.h"

namespace chiaro {

/// Where a walk met a surface. The receiver that bidirectional paths start from is one too, of
/// albedo pi: what it scatters is then its irradiance.
struct PathVertex {
    Receiver place;       // on the side that the walk came from
    Vec3 from;            // unit, toward where it came from
    Bsdf bsdf;            // as met from there
    Transport transport;  // radiance: a walk from the eye; importance: from a light
    Rgb throughput;       // of the walk, before it is scattered here
    Trail trail;
};

/// The eye's end of all paths.
PathVertex eye_end(const Receiver& receiver);

/// What a vertex does toward a direction.
struct Toward {
    Rgb carried = Rgb(0);  // what the walk would carry on, times the cosine [1 / steradian]
    float pdf = 0;         // with which it would go there, over solid angle
    float pdf_back = 0;    // with which the other walk, coming from there, would go to `from`
};
/// Along the unit vector `to`, deltas left out.
Toward toward(const PathVertex& vertex, Vec3 to);

/// One direction that a walk may go on along.
struct WalkStep {
    Vec3 direction;
    Rgb weight;  // what multiplies the throughput
    float pdf;   // as Toward has them; of a delta the factors that multiply it
    float pdf_back;
    bool delta;
    bool passes;  // to the other side
};
/// `u_lobe` in [0, 1), `u` in [0, 1)^2. Nothing: the walk ends.
std::optional<WalkStep> sample_step(const PathVertex& vertex, float u_lobe, Vec2 u);

/// Where rays that leave along `direction` start.
inline Vec3 origin_toward(const Receiver& place, Vec3 direction) {
    return glm::dot(place.geometric_normal, direction) > 0 ? place.origin
                                                           : 2.0f * place.position - place.origin;
}

}  // namespace chiaro
