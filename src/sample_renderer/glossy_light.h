// Radiance toward an eye by all that a surface does but diffuse reflection.
#pragma once

#include "sample_renderer/path_wave.h"

namespace chiaro {

/// Adds the estimates of samples [first, first + count) of a request for Light::glossy to the sums
/// of their replicates [cd/m2 a channel]. Each asks one light of each kind at the surface and
/// follows one path from there. What paths end at early is not added here (path_wave.h); they are
/// not asked at the surface itself.
///
/// The eye may be below the surface's real plane, as where a vertex is shared by faces that turn
/// away: it then counts as just above.
void add_glossy_samples(const LitScene& lit, const ShadeRequest& request, std::uint32_t first,
                        std::uint32_t count, PathWave& scratch, std::span<Rgb, kReplicates> sums,
                        const EndsAt* ends_at = nullptr);

/// The same of a request for Light::glint: paths end at the first surface that they meet, panes
/// aside, and find but what that emits, or the environment.
void add_glint_samples(const LitScene& lit, const ShadeRequest& request, std::uint32_t first,
                       std::uint32_t count, PathWave& scratch, std::span<Rgb, kReplicates> sums);

}  // namespace chiaro
