// A flat mesh of many triangles with levels coarser than itself, in a cache.
#pragma once

#include "shading_cache/cache_testing.h"

#include <vector>

namespace chiaro::tiny {

/// `columns` x `rows` unit squares, two triangles each, in the plane z = 0. Cells of the coarsest
/// level are a tenth of the diagonal: of 32 x 32 squares, 64 of 4.5 x 4.5.
struct DenseGrid {
    Scene scene;
    MeshGraphs graphs;
    ShadingCache cache;

    DenseGrid(int columns, int rows, int channels = 1)
        : scene(grid(columns, rows, true)),
          graphs(scene, CoarserLevels::up_to_a_tenth, 1),
          cache(scene, graphs, {channels}, SplitRule::by_shape) {}
    DenseGrid(const DenseGrid&) = delete;
    DenseGrid& operator=(const DenseGrid&) = delete;

    const Mesh& mesh() const { return scene.meshes[0]; }
    const MeshGraph& graph() const { return graphs.of(MeshId{0}); }
};

inline Vec3 position(const ShadingCache& cache, VertexId id) {
    return surface_geometry(cache.scene(), cache.surface_point(id)).position;
}

/// Vertices of meshes that nothing predicts, in order.
inline std::vector<VertexId> coarsest(const ShadingCache& cache) {
    std::vector<VertexId> found;
    for (std::uint32_t i = 0; i < cache.vertices().size(); ++i)
        if (cache.vertices()[i].of_mesh && cache.parents(static_cast<VertexId>(i)).empty())
            found.push_back(static_cast<VertexId>(i));
    return found;
}

/// All vertices, in order.
inline std::vector<VertexId> all_vertices(const ShadingCache& cache) {
    std::vector<VertexId> all;
    for (std::uint32_t i = 0; i < cache.vertices().size(); ++i)
        all.push_back(static_cast<VertexId>(i));
    return all;
}

/// What two caches of the same vertices show is the same to the bit.
inline void expect_same_shown(const ShadingCache& a, const ShadingCache& b) {
    ASSERT_EQ(a.vertices().size(), b.vertices().size());
    for (const VertexId v : all_vertices(a))
        for (int c = 0; c < a.channels(); ++c) {
            EXPECT_EQ(a.shown(v, c).value, b.shown(v, c).value) << index_of(v);
            EXPECT_EQ(a.shown(v, c).weight, b.shown(v, c).weight) << index_of(v);
        }
}

}  // namespace chiaro::tiny
