// Radiance along single rays, by paths traced to their ends.
#pragma once

#include "sample_renderer/path_wave.h"

namespace chiaro {

/// How rays are sampled. Ray i of a call has random numbers of its own, named by (seed, i).
struct RadianceSettings {
    std::uint32_t seed = 0;
    std::uint32_t first_sample = 0;
    std::uint32_t samples = 1;  // paths a ray
    int threads = 1;
};

/// Mean radiance that arrives along each ray, against its direction [cd/m2 a channel]; `result` has
/// the length of `rays`. What the surface emits counts; a ray that meets nothing sees the
/// environment. As a camera's, the rays pass single-sided faces from behind. The same bits on any
/// number of threads.
void radiance(const LitScene& lit, std::span<const Ray> rays, const RadianceSettings& settings,
              std::span<Rgb> result);

}  // namespace chiaro
