// Indirect light whose first ray is also aimed at specular surfaces: what they focus on a point,
// few rays of a cosine distribution find (the paper's Figure 6: "area sampling the glossy
// surfaces").
#pragma once

#include "sample_renderer/indirect_light.h"
#include "scene/sampled_surfaces.h"

namespace chiaro {

/// The surfaces of a scene that focus light: metal and bodies of glass up to kRoughestFocus, by how
/// much they reflect or transmit. Panes are none.
SampledSurfaces focusing_surfaces(const Scene& scene);
inline constexpr float kRoughestFocus = 0.6f;  // perceptual roughness

/// As add_indirect_samples(), by twice as many rays: each sample sends one that is distributed by
/// the cosine and one to a point of the surfaces. Directions that both may take are weighted by the
/// balance heuristic; a ray that something else stops before its point counts for nothing.
RayCount add_caustic_samples(const LitScene& lit, const SampledSurfaces& focusing,
                             const OpenSides* open_sides, const Receiver& receiver,
                             std::uint32_t seed, std::uint32_t first, std::uint32_t count,
                             PathWave& scratch, std::span<Rgb, kReplicates> sums);

}  // namespace chiaro
