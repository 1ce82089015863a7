// Irradiance straight from lights at one point: every punctual light, and the area lights and the
// environment by samples.
#pragma once

#include "sample_renderer/path_wave.h"

namespace chiaro {

/// Up to this many lamps, and as many suns, are all asked, once, which leaves no noise; more are
/// chosen from.
inline constexpr std::size_t kMostExactLights = 16;

/// What does not depend on samples: lamps if they are few, suns if they are [lux a channel].
Rgb exact_direct_light(const LitScene& lit, const Receiver& receiver, PathWave& scratch);

/// True if exact_direct_light() is all of it.
bool direct_light_is_exact(const LitScene& lit);

/// Adds the estimates of samples [first, first + count) to the sums of their replicates: area
/// lights and the environment by light samples, and by every eighth sample's cosine-distributed ray
/// too, weighted together by the balance heuristic; lamps and suns by what they may bring, where
/// exact_direct_light() leaves them out.
void add_direct_samples(const LitScene& lit, const Receiver& receiver, std::uint32_t seed,
                        std::uint32_t first, std::uint32_t count, PathWave& scratch,
                        std::span<Rgb, kReplicates> sums);

}  // namespace chiaro
