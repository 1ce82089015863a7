// Weights of multiple importance sampling for paths that two walks find together, one from a light
// and one from the eye: pure functions of what each walk knows of its own past.
//
// A path of k vertices can be found in up to k + 1 ways, the walks meeting at any of its edges, and
// the weights of all ways sum to 1 (Veach and Guibas 1995). A walk carries along the sum over all
// ways in which it is shorter, as far as that is settled: the rest hangs on the next two vertices,
// so that a weight costs the same however long the path (after Georgiev, "Implementing Vertex
// Connection and Merging", 2012).
//
// A delta vertex is the end of no walk. Its density stands for the factor that multiplies the
// delta, the same in all ways.
#pragma once

#include <algorithm>

namespace chiaro {

/// What counts in a weight of the ratio of two ways' densities: its square (the power heuristic;
/// Veach 1997, 9.2.2). Bounded, as sums are: beyond that a weight is 0 all the same.
inline float heuristic(float ratio) {
    const float bounded = std::min(ratio, 1e15f);
    return bounded * bounded;
}
inline constexpr float kLargestSum = 1e30f;

/// A walk's past at its newest vertex. Densities are over area, where a light is infinitely far
/// over its directions; sums are of heuristic(), relative to the way in which the walk ends there.
struct Trail {
    float density = 1;         // with which the walk found this vertex from the one before
    float density_before = 1;  // and that one from its own
    float to_before = 0;    // takes a density over solid angle here to one over area of that before
    float ends_before = 0;  // the way in which it ends one vertex before, were all densities equal
    float ends_earlier = 0;  // the ways in which it ends earlier, relative to that
};

/// The trail of a walk that goes on from a vertex; the next vertex adds its density and its
/// to_before. `pdf_back`: density over solid angle with which the other walk, coming against the
/// new direction, would go where this one came from. `delta`: the scattering is one.
inline Trail going_on(const Trail& here, float pdf_back, bool delta) {
    const float back = heuristic(pdf_back * here.to_before / here.density_before);
    Trail next;
    next.density_before = here.density;
    next.ends_before = delta ? 0.0f : 1.0f;
    next.ends_earlier =
        std::min(next.ends_before * here.ends_before + back * here.ends_earlier, kLargestSum);
    return next;
}

/// Sum over all ways in which a walk has fewer vertices than it has here, where another goes on:
/// that finds this vertex with `density`, and takes the one before with `pdf_back` as above.
inline float shorter_ways(const Trail& here, float density, float pdf_back) {
    const float back = heuristic(pdf_back * here.to_before / here.density_before);
    return heuristic(density / here.density) *
           std::min(here.ends_before + back * here.ends_earlier, kLargestSum);
}

/// The densities of one end of a path, a point of a light.
struct LightEnd {
    float walk;    // with which walks from lights start there
    float chosen;  // with which next event estimation chooses it at the vertex that it lights
};

/// As above, where a walk from the eye met the light itself; `pdf_back` is that of a walk which
/// starts there.
inline float shorter_ways(const Trail& here, const LightEnd& light, float pdf_back) {
    const float back = heuristic(pdf_back * here.to_before / here.density_before);
    return heuristic(light.chosen / here.density) * here.ends_before +
           heuristic(light.walk / here.density) * std::min(back * here.ends_earlier, kLargestSum);
}

/// Weight of a way from what the other ways sum up to.
inline float mis_weight(float fewer_from_light, float fewer_from_eye) {
    return 1 / (1 + fewer_from_light + fewer_from_eye);
}

}  // namespace chiaro
