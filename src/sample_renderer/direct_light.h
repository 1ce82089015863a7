// Irradiance straight from lights at one point: every punctual light, and the area lights and the
// environment by samples.
#pragma once

#include "sample_renderer/path_wave.h"
#include "sample_renderer/sample_run.h"

namespace chiaro {

/// Up to this many lamps, and as many suns, are all asked, once, which leaves no noise; more are
/// chosen from.
inline constexpr std::size_t kMostExactLights = 16;

/// Adds what does not depend on samples, lamps if they are few, suns if they are, to one sum a run
/// [lux a channel].
void add_exact_direct_light(const LitScene& lit, std::span<const SampleRun> runs, PathWave& scratch,
                            std::span<Rgb> sums);

/// True if add_exact_direct_light() adds all of it.
bool direct_light_is_exact(const LitScene& lit);

/// Adds the estimates of all runs to the sums of their replicates (sample_run.h): area lights and
/// the environment by light samples, and by every eighth sample's cosine-distributed ray too,
/// weighted together by the balance heuristic; lamps and suns by what they may bring, where
/// add_exact_direct_light() leaves them out.
void add_direct_samples(const LitScene& lit, std::span<const SampleRun> runs, PathWave& scratch,
                        std::span<Rgb> sums);

}  // namespace chiaro
