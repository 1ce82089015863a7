// Irradiance after at least one scattering at one point, by bidirectional path tracing: walks from
// the point and from lights, joined at every pair of their vertices.
// Source: Veach and Guibas, "Bidirectional Estimators for Light Transport", 1994; Veach's thesis,
// 1997, chapter 10.
#pragma once

#include "sample_renderer/indirect_light.h"
#include "sample_renderer/walk.h"

namespace chiaro {

/// Scratch memory; reuse it, so that nothing is allocated in the inner loop.
struct BidirectionalScratch {
    /// A place that a walk from a light met, and the one before of the same sample.
    struct Stored {
        PathVertex vertex;
        std::uint32_t previous;
    };

    WalkWave wave;
    std::vector<Emission> emissions;  // by sample of the wave
    std::vector<Stored> light_vertices;
    std::vector<std::uint32_t> newest;  // by sample: in light_vertices, or kNone
    ShadowBatch shadows;
};

/// What the samples are of; `open_sides` may be null.
struct BidirectionalScene {
    const LitScene& lit;
    const Emitters& emitters;
    const OpenSides* open_sides;
};

/// As add_indirect_samples(). A sample is a walk from the point and one from a light, by power:
/// every path is found by chance at the light, by light samples, and by joining the walks, the
/// point itself included; what it cannot use are walks from lights that meet the point by chance.
RayCount add_bidirectional_samples(const BidirectionalScene& scene, const SampleRun& run,
                                   BidirectionalScratch& scratch, std::span<Rgb, kReplicates> sums);

}  // namespace chiaro
