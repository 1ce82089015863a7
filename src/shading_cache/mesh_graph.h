// The vertices of a mesh as the cache has them, and how the values of most can be predicted from
// those of a few: levels coarser than the mesh, made once at load.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace chiaro {

/// A vertex of a mesh: a position in the arrays of a MeshGraph.
enum class MeshVertexId : std::uint32_t { none = 0xffff'ffff };

/// A corner of one primitive of a mesh.
struct MeshCorner {
    std::uint32_t primitive;
    int corner;  // 0 to 3
};

/// Corners are numbered through: four of each quad, then three of each triangle.
std::uint32_t corner_index(const Mesh& mesh, MeshCorner corner);
MeshCorner corner_at(const Mesh& mesh, std::uint32_t index);
std::size_t corner_count(const Mesh& mesh);

/// How coarse levels may become.
struct LevelSettings {
    /// Size of the cells of the coarsest level, in object space; 0: no level but the mesh's own.
    float top_cell = 0;
    /// Cells of each level are half as large as those of the next coarser one.
    int levels = 10;
};

/// The vertices of one mesh in one graph: each has up to 4 parents of a coarser level with weights,
/// from which its value is predicted until it is evaluated itself.
///
/// Corners of primitives are one vertex where position and material agree and the normals are
/// within 16 degrees (1 degree on meshes without normals, whose faces are flat). Level 0 are all
/// vertices; level l are those of level l - 1 that stand for the others in their cell of its grid,
/// one for each sheet of surface, way it faces and material. Parents are near, of the same material
/// and on a surface that continues the vertex's own; their weights reproduce linear functions where
/// they lie all round it. Only vertices of the coarsest level have none. With levels, vertices of
/// near numbers are near each other.
struct MeshGraph {
    static constexpr int kFullWeight = 128;  // weights are multiples of 1/128, as in CacheVertex

    std::vector<std::uint32_t> vertex_of_corner;  // by corner_index()
    std::vector<std::uint32_t> corner_of_vertex;  // by vertex: the corner at which it is sampled
    std::vector<std::uint8_t> level;              // by vertex: the coarsest level that it is in
    // Parents of vertex v: entries [first_parent[v], first_parent[v + 1]).
    std::vector<std::uint32_t> first_parent;
    std::vector<std::uint32_t> parents;
    std::vector<std::uint8_t> weights;  // of each vertex's parents, sum kFullWeight

    std::size_t vertex_count() const { return corner_of_vertex.size(); }
    std::span<const std::uint32_t> parents_of(MeshVertexId vertex) const {
        const auto v = index_of(vertex);
        return std::span(parents).subspan(first_parent[v], first_parent[v + 1] - first_parent[v]);
    }
    std::span<const std::uint8_t> weights_of(MeshVertexId vertex) const {
        const auto v = index_of(vertex);
        return std::span(weights).subspan(first_parent[v], first_parent[v + 1] - first_parent[v]);
    }
    /// Bytes of the arrays.
    std::size_t bytes() const;
};

/// The graph of one mesh; the same on any number of threads. Source: vertex clustering (Rossignac,
/// Borrel 1993) with weights by moving least squares (Levin 1998).
MeshGraph make_mesh_graph(const Mesh& mesh, const LevelSettings& settings, int threads);

/// Which levels a scene's meshes get.
enum class CoarserLevels { none, up_to_a_tenth };

/// Graphs of all meshes, shared by the objects that show them. The coarsest cells are 1/10 of the
/// scene's diagonal, at the scale of the largest object that shows the mesh.
class MeshGraphs {
public:
    MeshGraphs(const Scene& scene, CoarserLevels levels, int threads);

    /// Makes those of meshes that were appended to the scene since.
    void add_meshes(const Scene& scene, int threads);

    const MeshGraph& of(MeshId mesh) const { return graphs_[index_of(mesh)]; }
    std::size_t bytes() const;

private:
    CoarserLevels levels_;
    std::vector<MeshGraph> graphs_;  // by mesh
};

}  // namespace chiaro
