// The first picture (design, section 3): everything in view is evaluated at an even density.
#pragma once

#include "shading_cache/id_map.h"
#include "update/shade_work.h"

#include <span>

namespace chiaro {

/// Divides the patches that cover most of the view, the largest first, until a channel's front has
/// about `vertex_budget` vertices in view or no patch of it covers more than a few pixels. What is
/// divided counts as refined in that channel.
void even_out(ShadingCache& cache, IdMap& map, int channel, std::size_t vertex_budget, Cycle now);

/// Corners in view of a channel's front where it is not evaluated.
std::size_t missing_in_view(const ShadingCache& cache, int channel);

/// Asks for every channel at every corner of the patches in view that it lights and that it is not
/// refined below, where it is missing, with `samples` of each channel (0: as its plan says).
void evaluate_in_view(const ShadingCache& cache, std::span<const std::uint32_t> samples,
                      ShadeWork& work);

/// Patches in view all or all but one of whose corners are buried, although something of them is
/// seen: those of a channel's front that can be divided further.
std::vector<PatchId> dug_in(const ShadingCache& cache, int channel);

/// Corners of a patch in view that is small and buried all over cannot be buried: exposes them.
void expose_if_seen(ShadingCache& cache, PatchId patch);

}  // namespace chiaro
