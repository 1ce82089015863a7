// Levels of a mesh that are coarser than itself, by clustering of its vertices.
#pragma once

#include "shading_cache/mesh_graph.h"

namespace chiaro {

/// Gives the vertices of `graph`, which has no levels yet, their levels and parents, and numbers
/// them anew so that those of near numbers are near each other. The same on any number of threads.
void add_levels(const Mesh& mesh, const LevelSettings& settings, int threads, MeshGraph& graph);

}  // namespace chiaro
