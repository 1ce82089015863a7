#include "shading_cache/mesh_graph.h"

#include "base/parallel.h"
#include "shading_cache/arrays.h"
#include "shading_cache/mesh_levels.h"
#include "shading_cache/weld.h"

#include <algorithm>

namespace chiaro {
namespace {

// Meshes of fewer corners are made one a thread, larger ones by all threads together.
constexpr std::size_t kSmallMesh = 100'000;

constexpr float kTopCellsOfDiagonal = 10;

// How much longer the longest edge of a unit cube gets.
float largest_scale(const Mat4& to_world) {
    float scale = 0;
    for (int i = 0; i < 3; ++i) scale = std::max(scale, glm::length(Vec3(to_world[i])));
    return scale;
}

// Sizes of the coarsest cells, by mesh; 0 for those that no object shows.
std::vector<float> top_cells(const Scene& scene) {
    std::vector<float> scales(scene.meshes.size(), 0.0f);
    for (const Object& object : scene.objects) {
        float& scale = scales[index_of(object.mesh)];
        scale = std::max(scale, largest_scale(object.to_world));
    }
    const float cell = bounds(scene).diagonal() / kTopCellsOfDiagonal;
    for (float& scale : scales) scale = scale > 0 ? cell / scale : 0.0f;
    return scales;
}

}  // namespace

std::uint32_t corner_index(const Mesh& mesh, MeshCorner corner) {
    const std::uint32_t quads = std::min(corner.primitive, mesh.quad_count);
    return 4 * quads + 3 * (corner.primitive - quads) + static_cast<std::uint32_t>(corner.corner);
}

MeshCorner corner_at(const Mesh& mesh, std::uint32_t index) {
    const std::uint32_t of_quads = 4 * mesh.quad_count;
    if (index < of_quads) return {index / 4, static_cast<int>(index % 4)};
    const std::uint32_t rest = index - of_quads;
    return {mesh.quad_count + rest / 3, static_cast<int>(rest % 3)};
}

std::size_t corner_count(const Mesh& mesh) {
    return 3 * mesh.primitives.size() + mesh.quad_count;
}

std::size_t MeshGraph::bytes() const {
    return bytes_of(vertex_of_corner) + bytes_of(corner_of_vertex) + bytes_of(level) +
           bytes_of(first_parent) + bytes_of(parents) + bytes_of(weights);
}

MeshGraph make_mesh_graph(const Mesh& mesh, const LevelSettings& settings, int threads) {
    Weld weld = weld_corners(mesh, threads);
    MeshGraph graph;
    graph.vertex_of_corner = std::move(weld.vertex_of_corner);
    graph.corner_of_vertex = std::move(weld.corner_of_vertex);
    graph.level.assign(graph.vertex_count(), 0);
    graph.first_parent.assign(graph.vertex_count() + 1, 0);
    add_levels(mesh, settings, threads, graph);
    return graph;
}

MeshGraphs::MeshGraphs(const Scene& scene, CoarserLevels levels, int threads) : levels_(levels) {
    add_meshes(scene, threads);
}

void MeshGraphs::add_meshes(const Scene& scene, int threads) {
    const std::size_t first = graphs_.size();
    if (first == scene.meshes.size()) return;
    graphs_.resize(scene.meshes.size());
    std::vector<float> cells(scene.meshes.size(), 0.0f);
    if (levels_ == CoarserLevels::up_to_a_tenth) cells = top_cells(scene);
    const auto small = [&](std::size_t i) { return corner_count(scene.meshes[i]) < kSmallMesh; };
    parallel_for(threads, graphs_.size() - first, [&](std::size_t k) {
        const std::size_t i = first + k;
        if (small(i)) graphs_[i] = make_mesh_graph(scene.meshes[i], {.top_cell = cells[i]}, 1);
    });
    for (std::size_t i = first; i < graphs_.size(); ++i)
        if (!small(i))
            graphs_[i] = make_mesh_graph(scene.meshes[i], {.top_cell = cells[i]}, threads);
}

std::size_t MeshGraphs::bytes() const {
    std::size_t total = bytes_of(graphs_);
    for (const MeshGraph& graph : graphs_) total += graph.bytes();
    return total;
}

}  // namespace chiaro
