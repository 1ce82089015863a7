// First rays of paths aimed at some surfaces, beside those that are distributed by the cosine: what
// is small and bright, few of the latter find.
#pragma once

#include "sample_renderer/path_wave.h"
#include "sample_renderer/sample_run.h"
#include "sample_renderer/sequence.h"
#include "scene/sampled_surfaces.h"

namespace chiaro {

/// Surfaces to aim at; one in `every` samples of a replicate also sends a ray to them.
struct Aims {
    const SampledSurfaces& surfaces;  // not empty
    std::uint32_t every = 1;
};

/// What a ray is aimed at, and how far that is.
struct Target {
    SurfacePoint point;
    float distance;
};

/// Adds the aimed rays of all runs to a wave that holds their rays of the cosine distribution.
/// `targets` gets what each is aimed at.
void add_aimed_rays(const Aims& aims, std::span<const SampleRun> runs, PathWave& wave,
                    std::vector<Target>& targets);

/// To be called when all first rays are cast. Leaves out what met nothing, and the aimed rays (the
/// last of the wave) that something else stopped before their target; weights all the rest by the
/// balance heuristic.
void weigh_aimed_rays(const Aims& aims, std::span<const SampleRun> runs,
                      std::span<const Target> targets, PathWave& wave);

}  // namespace chiaro
