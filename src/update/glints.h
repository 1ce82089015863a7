// What polish shows of lights: light samples instead of rays that would have to find them.
#pragma once

#include "sample_renderer/sample_renderer.h"
#include "shading_cache/id_map.h"

namespace chiaro {

/// Samples of lights that a pixel's polish takes when the view rests, and again in every pass.
inline constexpr std::uint32_t kGlintSamples = 4 * kReplicates;

/// What a glint shows of lights; of `samples` the fewer the less of the pixel it is, a multiple of
/// kReplicates.
ShadeRequest glint_request(const Glint& glint, std::uint32_t seed, std::uint32_t samples);

}  // namespace chiaro
