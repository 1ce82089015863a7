// Which corners of a mesh are one vertex.
#pragma once

#include "shading_cache/mesh_graph.h"

namespace chiaro {

/// Vertices of a mesh, near each other in number where points of the mesh are.
struct Weld {
    std::vector<std::uint32_t> vertex_of_corner;  // by corner_index()
    std::vector<std::uint32_t> corner_of_vertex;  // the first of a vertex's corners
};

/// Makes corners of one position and material one vertex where their normals are within 16 degrees
/// of that of its first corner, or 1 degree on a mesh without normals. The same on any number of
/// threads. Checks: 32 bits count all corners.
Weld weld_corners(const Mesh& mesh, int threads);

/// Unit normal in object space that the mesh has at a corner, on the front of its primitive; where
/// the mesh has no normals, that of the triangle of Embree's map which holds the corner.
Vec3 corner_normal(const Mesh& mesh, MeshCorner corner);

}  // namespace chiaro
