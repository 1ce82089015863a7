// The first picture (design, section 3): everything in view is evaluated at an even density.
#pragma once

#include "sample_selector/mesh_front.h"
#include "shading_cache/id_map.h"
#include "update/shade_work.h"

#include <span>

namespace chiaro {

/// How coarse the first picture starts in one channel.
struct StartLevel {
    int level = 0;             // vertices of meshes that stand for this or coarser levels start
    std::size_t vertices = 0;  // as many patches or vertices as the view is divided into
};

/// The finest level whose vertices in view, with large patches divided to the same density, are at
/// most `most`. On level 0, which is the paper's start, large patches are divided until `fewest`
/// patches are in view.
StartLevel choose_start_level(const ShadingCache& cache, const MeshFront& mesh, int channel,
                              std::size_t fewest, std::size_t most);

/// Divides the patches that cover most of the view, the largest first, until a channel is divided
/// into as many as `start` says or no patch of its front covers more than a few pixels. What is
/// divided counts as refined in that channel.
void even_out(ShadingCache& cache, IdMap& map, const MeshFront& mesh, int channel,
              const StartLevel& start, Cycle now);

/// Vertices that a channel is to start with and that are not evaluated in it, each once: those of
/// meshes that stand for its start level, and corners of patches in view of its front that it
/// lights, but for corners of the mesh below that level.
std::vector<VertexId> missing_in_view(const ShadingCache& cache, const MeshFront& mesh, int channel,
                                      int start_level);

/// Vertices of meshes on which a pixel or more weighs in a channel, not evaluated in it, that are
/// hollow: nothing predicts their light. (Smaller ones gain much, and soon have their turn, but for
/// those that were evaluated in another channel, which count for nothing until then.)
std::vector<VertexId> hollow_in_view(const ShadingCache& cache, const MeshFront& mesh, int channel);

/// Patches in view all or all but one of whose corners are buried, although something of them is
/// seen: those of a channel's front that can be divided further.
std::vector<PatchId> dug_in(const ShadingCache& cache, int channel);

/// Corners of a patch in view that is small and buried all over cannot be buried: exposes them.
void expose_if_seen(ShadingCache& cache, PatchId patch);

}  // namespace chiaro
