// Surfaces that lights make much brighter than the rest: a lampshade, the frame of a ceiling lamp.
#pragma once

#include "sample_renderer/next_event.h"

namespace chiaro {

/// Primitives that reflect at least kBright times the mean radiance of what lights shine on,
/// weighted by their radiance: found by a fixed number of rays from the lights, where enough of
/// them land. Emission does not count.
SampledSurfaces bright_surfaces(const LitScene& lit, int threads);
inline constexpr float kBright = 4;

}  // namespace chiaro
