#include "shading_cache/mesh_levels.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "shading_cache/cell_grid.h"
#include "shading_cache/near_vertices.h"
#include "shading_cache/weld.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chiaro {
namespace {

constexpr std::size_t kRange = 4096;  // what one body of a parallel loop does at once

// The grids of all levels: those whose cells are too small to be counted are left out.
struct Grids {
    MortonGrid finest;
    int finest_level;
    LevelGrid of(int level) const {
        const int steps = level - finest_level;
        return {3 * steps, static_cast<float>(std::ldexp(finest.cell, steps))};
    }
};

Grids make_grids(const Mesh& mesh, const LevelSettings& settings) {
    Box box;
    for (const Vec3 p : mesh.positions) box.add(p);
    double extent = 0;
    for (int i = 0; i < 3; ++i)
        extent = std::max(extent, static_cast<double>(box.high[i]) - box.low[i]);
    int level = settings.levels;
    double cell = settings.top_cell;
    while (level > 1 && extent / (0.5 * cell) < kMostCells) {
        cell *= 0.5;
        --level;
    }
    return {{box.low, cell}, level};
}

Vec3 corner_position(const Mesh& mesh, MeshCorner corner) {
    return mesh.positions[mesh.primitives[corner.primitive].corners[corner.corner]];
}

// Numbers the vertices in the order of their cells, and returns them.
std::vector<LevelVertex> order_vertices(const Mesh& mesh, const MortonGrid& grid, int threads,
                                        MeshGraph& graph) {
    const std::size_t count = graph.vertex_count();
    std::vector<KeyedIndex> order(count);
    parallel_for_ranges(threads, count, kRange, [&](IndexRange r) {
        for (std::size_t i = r.begin; i < r.end; ++i) {
            const MeshCorner corner = corner_at(mesh, graph.corner_of_vertex[i]);
            order[i] = {grid.code_at(corner_position(mesh, corner)), static_cast<std::uint32_t>(i)};
        }
    });
    parallel_sort(threads, order);

    std::vector<LevelVertex> vertices(count);
    std::vector<std::uint32_t> new_number(count);
    const std::vector<std::uint32_t> corners = std::move(graph.corner_of_vertex);
    graph.corner_of_vertex.resize(count);
    parallel_for_ranges(threads, count, kRange, [&](IndexRange r) {
        for (std::size_t i = r.begin; i < r.end; ++i) {
            const std::uint32_t index = corners[order[i].index];
            const MeshCorner corner = corner_at(mesh, index);
            graph.corner_of_vertex[i] = index;
            new_number[order[i].index] = static_cast<std::uint32_t>(i);
            const Vec3 position = corner_position(mesh, corner);
            vertices[i] = {order[i].key,
                           position,
                           position,
                           corner_normal(mesh, corner),
                           mesh.primitives[corner.primitive].material,
                           static_cast<std::uint32_t>(i)};
        }
    });
    parallel_for_ranges(threads, graph.vertex_of_corner.size(), kRange, [&](IndexRange r) {
        for (std::size_t i = r.begin; i < r.end; ++i)
            graph.vertex_of_corner[i] = new_number[graph.vertex_of_corner[i]];
    });
    return vertices;
}

// Those that stand for themselves, in order.
std::vector<LevelVertex> keep_representatives(std::span<const LevelVertex> vertices,
                                              std::span<const std::uint32_t> representatives,
                                              int threads) {
    std::vector<std::size_t> first((vertices.size() + kRange - 1) / kRange);
    parallel_for_ranges(threads, vertices.size(), kRange, [&](IndexRange r) {
        for (std::size_t i = r.begin; i < r.end; ++i)
            first[r.number] += representatives[i] == i ? 1 : 0;
    });
    std::size_t count = 0;
    for (std::size_t& f : first) f = std::exchange(count, count + f);
    if (count == vertices.size()) return {};
    std::vector<LevelVertex> kept(count);
    parallel_for_ranges(threads, vertices.size(), kRange, [&](IndexRange r) {
        std::size_t next = first[r.number];
        for (std::size_t i = r.begin; i < r.end; ++i)
            if (representatives[i] == i) kept[next++] = vertices[i];
    });
    return kept;
}

// Finds parents among `kept` for those of `vertices` that do not stand for themselves.
void find_parents(std::span<const LevelVertex> vertices,
                  std::span<const std::uint32_t> representatives, const NearVertices& kept,
                  const LevelGrid& grid, int threads, std::span<ChosenParents> parents) {
    parallel_for_ranges(threads, vertices.size(), kRange, [&](IndexRange r) {
        std::vector<LevelVertex> near;
        for_cells(vertices, grid, r.begin, r.end, [&](std::size_t first, std::size_t end) {
            near.clear();
            for (std::size_t i = first; i < end; ++i) {
                if (representatives[i] == i) continue;
                const LevelVertex& representative = vertices[representatives[i]];
                const ChosenParents alone = {{representative.vertex}, {MeshGraph::kFullWeight}};
                ChosenParents& set = parents[vertices[i].vertex];
                set = alone;
                if (vertices[i].position == representative.position) continue;
                if (near.empty()) kept.find(grid.code(vertices[i]), near);
                set = choose_parents(vertices[i], near, grid.cell);
                // Its representative continued its surface before it got its mean normal.
                if (set.empty()) set = alone;
            }
        });
    });
}

// Writes down the parents that there are, one vertex after the other.
void pack_parents(std::span<const ChosenParents> sets, int threads, MeshGraph& graph) {
    const auto count = [](const ChosenParents& set) {
        return static_cast<std::uint32_t>(
            std::ranges::count_if(set.weights, [](std::uint8_t w) { return w > 0; }));
    };
    std::size_t sum = 0;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        graph.first_parent[i] = static_cast<std::uint32_t>(sum);
        sum += count(sets[i]);
    }
    check(sum < 0xffff'ffff, "add_levels: more parents than ids");
    graph.first_parent[sets.size()] = static_cast<std::uint32_t>(sum);
    graph.parents.resize(sum);
    graph.weights.resize(sum);
    parallel_for_ranges(threads, sets.size(), kRange, [&](IndexRange r) {
        std::size_t next = graph.first_parent[r.begin];
        for (std::size_t i = r.begin; i < r.end; ++i)
            for (int k = 0; k < 4; ++k) {
                if (sets[i].weights[k] == 0) continue;
                graph.parents[next] = sets[i].vertices[k];
                graph.weights[next++] = sets[i].weights[k];
            }
    });
}

}  // namespace

void add_levels(const Mesh& mesh, const LevelSettings& settings, int threads, MeshGraph& graph) {
    if (settings.top_cell <= 0 || settings.levels <= 0 || graph.vertex_count() == 0) return;
    const Grids grids = make_grids(mesh, settings);
    std::vector<LevelVertex> vertices = order_vertices(mesh, grids.finest, threads, graph);
    std::vector<ChosenParents> parents(graph.vertex_count());
    graph.level.assign(graph.vertex_count(), static_cast<std::uint8_t>(settings.levels));
    for (int level = grids.finest_level; level <= settings.levels; ++level) {
        const LevelGrid grid = grids.of(level);
        const auto representatives = choose_representatives(vertices, grid, threads);
        std::vector<LevelVertex> kept = keep_representatives(vertices, representatives, threads);
        if (kept.empty()) continue;  // all stand for themselves
        find_parents(vertices, representatives, NearVertices(kept, grid), grid, threads, parents);
        for (std::size_t i = 0; i < vertices.size(); ++i)
            if (representatives[i] != i)
                graph.level[vertices[i].vertex] = static_cast<std::uint8_t>(level - 1);
        vertices = std::move(kept);
    }
    pack_parents(parents, threads, graph);
}

}  // namespace chiaro
