// Levels coarser than the mesh: how many vertices they have, and which predict which.
#include "shading_cache/cache_testing.h"
#include "shading_cache/mesh_graph.h"

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

constexpr int kLevels = LevelSettings{}.levels;

// A mesh of sheets, and on which sheet each primitive lies.
struct Sheets {
    Mesh mesh;
    std::vector<int> sheet_of;
    int count = 0;

    /// Starts a sheet of squares of about `step`, with points of its own.
    void add(Vec3 corner, Vec3 u, Vec3 v, float step, MaterialId material = MaterialId{0}) {
        const auto squares = [&](Vec3 edge) {
            return static_cast<std::uint32_t>(std::lround(glm::length(edge) / step));
        };
        const std::uint32_t columns = squares(u), rows = squares(v);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::uint32_t y = 0; y <= rows; ++y)
            for (std::uint32_t x = 0; x <= columns; ++x)
                mesh.positions.push_back(corner + u * (float(x) / float(columns)) +
                                         v * (float(y) / float(rows)));
        for (std::uint32_t y = 0; y < rows; ++y)
            for (std::uint32_t x = 0; x < columns; ++x) {
                const std::uint32_t a = first + y * (columns + 1) + x, d = a + columns + 1;
                mesh.primitives.push_back(quad(a, a + 1, d + 1, d, material));
                sheet_of.push_back(count);
            }
        mesh.quad_count = static_cast<std::uint32_t>(mesh.primitives.size());
        ++count;
    }
    /// The six faces of a box, fronts outward, a sheet each.
    void add_faces(Vec3 size, float step) {
        const Vec3 o(0), x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
        for (const auto& [corner, u, v] :
             {std::array{o, y, x}, std::array{z, x, y}, std::array{o, x, z}, std::array{y, z, x},
              std::array{o, z, y}, std::array{x, y, z}})
            add(corner, u, v, step);
    }
};

std::uint32_t primitive_of(const Mesh& mesh, const MeshGraph& graph, std::uint32_t vertex) {
    return corner_at(mesh, graph.corner_of_vertex[vertex]).primitive;
}
Vec3 position_of(const Mesh& mesh, const MeshGraph& graph, std::uint32_t vertex) {
    const MeshCorner corner = corner_at(mesh, graph.corner_of_vertex[vertex]);
    return mesh.positions[mesh.primitives[corner.primitive].corners[corner.corner]];
}

// How many vertices each level has: those whose coarsest it is and those of the coarser ones.
std::array<std::size_t, kLevels + 1> populations(const MeshGraph& graph) {
    std::array<std::size_t, kLevels + 1> result = {};
    for (const std::uint8_t level : graph.level)
        for (int l = 0; l <= level; ++l) ++result[l];
    return result;
}

// What holds of any graph: parents are of a coarser level, weights positive and add up to one.
void expect_sound(const MeshGraph& graph) {
    ASSERT_EQ(graph.level.size(), graph.vertex_count());
    ASSERT_EQ(graph.first_parent.size(), graph.vertex_count() + 1);
    ASSERT_EQ(graph.first_parent.back(), graph.parents.size());
    ASSERT_EQ(graph.weights.size(), graph.parents.size());
    for (std::uint32_t v = 0; v < graph.vertex_count(); ++v) {
        const auto parents = graph.parents_of(MeshVertexId{v});
        const auto weights = graph.weights_of(MeshVertexId{v});
        ASSERT_LE(parents.size(), 4u);
        ASSERT_EQ(parents.empty(), graph.level[v] == kLevels);
        int sum = 0;
        for (std::size_t i = 0; i < parents.size(); ++i) {
            ASSERT_GT(graph.level[parents[i]], graph.level[v]);
            ASSERT_GT(weights[i], 0);
            sum += weights[i];
        }
        if (!parents.empty()) {
            ASSERT_EQ(sum, MeshGraph::kFullWeight);
        }
    }
}

// Parents that lie on another sheet than their child. Where there are none, no ancestor does.
int parents_on_other_sheets(const Sheets& sheets, const MeshGraph& graph) {
    const auto sheet = [&](std::uint32_t v) {
        return sheets.sheet_of[primitive_of(sheets.mesh, graph, v)];
    };
    int count = 0;
    for (std::uint32_t v = 0; v < graph.vertex_count(); ++v)
        for (const std::uint32_t parent : graph.parents_of(MeshVertexId{v}))
            count += sheet(parent) != sheet(v) ? 1 : 0;
    return count;
}

// Values at all vertices if those at vertices without parents are `value(position)`.
template <typename Value>
std::vector<Vec3> resolved(const Mesh& mesh, const MeshGraph& graph, const Value& value) {
    std::vector<Vec3> values(graph.vertex_count());
    for (int level = kLevels; level >= 0; --level)
        for (std::uint32_t v = 0; v < graph.vertex_count(); ++v) {
            if (graph.level[v] != level) continue;
            const auto parents = graph.parents_of(MeshVertexId{v});
            const auto weights = graph.weights_of(MeshVertexId{v});
            if (parents.empty()) values[v] = value(position_of(mesh, graph, v));
            for (std::size_t i = 0; i < parents.size(); ++i)
                values[v] += values[parents[i]] * (float(weights[i]) / MeshGraph::kFullWeight);
        }
    return values;
}

// Builds the graph of thin things with cells of 20 cm, and expects that nothing is predicted from
// another sheet although all is from few vertices.
void expect_apart(const Sheets& sheets, std::size_t most_coarse) {
    const MeshGraph graph = make_mesh_graph(sheets.mesh, {.top_cell = 0.2f}, 2);
    expect_sound(graph);
    EXPECT_EQ(parents_on_other_sheets(sheets, graph), 0);
    EXPECT_LE(populations(graph)[kLevels], most_coarse);
}

// A ball of radius 0.5 in 2 n x n triangles or so.
Mesh ball(std::uint32_t n, bool normals) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i < 2 * n; ++i) {
            const float t = kPi * float(j) / float(n), p = kPi * float(i) / float(n);
            const Vec3 d(std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t));
            mesh.positions.push_back(0.5f * d);
            if (normals) mesh.normals.push_back(d);
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < 2 * n; ++i) {
            const std::uint32_t a = 2 * n * j + i, b = 2 * n * j + (i + 1) % (2 * n);
            mesh.primitives.push_back(triangle(a, a + 2 * n, b, MaterialId{0}));
            mesh.primitives.push_back(triangle(b, a + 2 * n, b + 2 * n, MaterialId{0}));
        }
    order_primitives(mesh);
    return mesh;
}

// The grid's 129 x 129 points stand one apart and cells are powers of two from its corner on: a
// cell of size c holds c x c of them, and one of these stands for all.
TEST(MeshLevels, AFlatGridHasOneVertexACell) {
    const Mesh mesh = grid(128, 128).meshes[0];
    const MeshGraph graph = make_mesh_graph(mesh, {.top_cell = 32}, 1);
    expect_sound(graph);
    const auto found = populations(graph);
    for (int level = 0; level <= kLevels; ++level) {
        const double cells = std::ceil(129 / std::max(1.0, std::ldexp(32.0, level - kLevels)));
        EXPECT_EQ(found[level], static_cast<std::size_t>(cells * cells)) << level;
    }
}

// Weights reproduce linear functions up to their steps of 1/128: a level's parents are two cells of
// it apart at most, so that a level adds half of 4 steps of 1/128 of that, all levels 1/8 cell at
// the very most. A cell and a half from the border vertices have parents all round.
TEST(MeshLevels, LinearFunctionsAreReproducedInside) {
    Sheets sheets;
    sheets.add({0, 0, 0}, {1.6f, 0.8f, 0}, {-0.8f, 1.6f, 0.3f}, 0.01f);
    const float cell = 0.2f;
    const Mesh& mesh = sheets.mesh;
    const MeshGraph graph = make_mesh_graph(mesh, {.top_cell = cell}, 1);
    expect_sound(graph);
    const auto values = resolved(mesh, graph, [](Vec3 p) { return p; });
    const Vec3 u = glm::normalize(mesh.positions[1] - mesh.positions[0]);
    const Vec3 v = glm::normalize(mesh.positions.back() - glm::dot(mesh.positions.back(), u) * u);
    const float length = glm::dot(mesh.positions.back(), u);
    const float width = glm::dot(mesh.positions.back(), v);
    int inside = 0;
    for (std::uint32_t i = 0; i < graph.vertex_count(); ++i) {
        const Vec3 p = position_of(mesh, graph, i);
        const float a = glm::dot(p, u), b = glm::dot(p, v);
        if (std::min({a, length - a, b, width - b}) < 1.5f * cell) continue;
        EXPECT_LT(glm::length(values[i] - p), cell / 8);
        ++inside;
    }
    EXPECT_GT(inside, 10000);
}

// Cells of 20 cm, as in a room of 8 m. Of the coarsest level there is one vertex or two a cell.
TEST(MeshLevels, ATableTopsSidesStayApart) {
    Sheets table;
    table.add_faces({1, 1, 0.03f}, 0.01f);
    expect_apart(table, 2 * (25 + 25 + 4 * 5));
}
TEST(MeshLevels, AChairLegsFacesStayApart) {
    Sheets leg;
    leg.add_faces({0.05f, 0.05f, 1}, 0.005f);
    expect_apart(leg, 2 * (4 * 5 + 2));
}
TEST(MeshLevels, SlatsOfABlindStayApart) {
    Sheets blind;
    for (int i = 0; i < 20; ++i)
        blind.add({0, 0, 0.03f * float(i)}, {0.05f, 0, 0}, {0, 1, 0}, 0.005f);
    expect_apart(blind, 2 * 20 * 5);
    Sheets tilted;
    for (int i = 0; i < 20; ++i)
        tilted.add({0, 0, 0.03f * float(i)}, {0.04f, 0, 0.03f}, {0, 1, 0}, 0.005f);
    expect_apart(tilted, 2 * 20 * 5);
}
TEST(MeshLevels, StepsOfAStairStayApart) {
    Sheets stair;
    for (int i = 0; i < 10; ++i) {
        const Vec3 edge(0, 0.3f * float(i), 0.17f * float(i));
        stair.add(edge, {1, 0, 0}, {0, 0, 0.17f}, 0.01f);
        stair.add(edge + Vec3(0, 0, 0.17f), {1, 0, 0}, {0, 0.3f, 0}, 0.01f);
    }
    // Treads lie in two or three rows of cells, risers in one or two.
    expect_apart(stair, 10 * (3 + 2) * 6);
}

// Slats that are bent to an arc of 40 degrees across: their normals meet those of their neighbours.
TEST(MeshLevels, BentSlatsStayApart) {
    Sheets blind;
    const float radius = 0.07f, step = glm::radians(4.0f);
    for (int i = 0; i < 20; ++i)
        for (int k = 0; k < 10; ++k) {
            const auto at = [&](int corner) {
                const float a = step * float(corner - 5);
                return Vec3(radius * std::sin(a), 0, 0.03f * float(i) + radius * std::cos(a));
            };
            blind.add(at(k), at(k + 1) - at(k), {0, 1, 0}, radius * step);
        }
    for (int& sheet : blind.sheet_of) sheet /= 10;
    expect_apart(blind, 2 * 20 * 5);
}

TEST(MeshLevels, OtherMaterialsStayApart) {
    Sheets floor;
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 10; ++x)
            floor.add({0.1f * float(x), 0.1f * float(y), 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, 0.01f,
                      static_cast<MaterialId>((x + y) % 2));
    const MeshGraph graph = make_mesh_graph(floor.mesh, {.top_cell = 0.2f}, 1);
    expect_sound(graph);
    const auto material = [&](std::uint32_t v) {
        return floor.mesh.primitives[primitive_of(floor.mesh, graph, v)].material;
    };
    for (std::uint32_t v = 0; v < graph.vertex_count(); ++v)
        for (const std::uint32_t parent : graph.parents_of(MeshVertexId{v}))
            EXPECT_EQ(material(parent), material(v));
    EXPECT_LE(populations(graph)[kLevels], 2u * 2 * 5 * 5);
}

// A chord of length s lies s^2 / 8 r below a ball of radius r. With parents two cells c apart that
// are at most c^2 / 2 r a level, and 4/3 of it for all levels, of which each finer one adds a
// quarter. The coarsest level has less than two vertices for each cell of a cube's faces.
TEST(MeshLevels, ABallIsFollowed) {
    const float cell = 0.2f;
    for (const bool normals : {true, false}) {
        const Mesh mesh = ball(120, normals);
        const MeshGraph graph = make_mesh_graph(mesh, {.top_cell = cell}, 2);
        expect_sound(graph);
        EXPECT_LT(populations(graph)[kLevels], 2u * 6 * 5 * 5);
        const auto values = resolved(mesh, graph, [](Vec3 p) { return p; });
        for (std::uint32_t v = 0; v < graph.vertex_count(); ++v)
            EXPECT_LT(glm::length(values[v] - position_of(mesh, graph, v)),
                      4.0f / 3 * cell * cell / (2 * 0.5f));
    }
}

// Measured surfaces: each point is off the plane by up to a third of the distance to the next.
TEST(MeshLevels, ANoisyPlaneGetsCoarser) {
    Sheets sheets;
    sheets.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0.005f);
    Mesh& mesh = sheets.mesh;
    Rng rng(5);
    for (Vec3& p : mesh.positions) p.z = 0.005f / 3 * (2 * rng.uniform() - 1);
    mesh.normals.assign(mesh.positions.size(), Vec3(0));
    for (const Primitive& p : mesh.primitives) {
        const auto at = [&](int c) { return mesh.positions[p.corners[c]]; };
        for (const std::uint32_t c : p.corners)
            mesh.normals[c] += glm::cross(at(2) - at(0), at(3) - at(1));
    }
    for (Vec3& n : mesh.normals) n = glm::normalize(n);
    const MeshGraph graph = make_mesh_graph(mesh, {.top_cell = 0.2f}, 2);
    expect_sound(graph);
    // 5 x 5 cells of the coarsest level.
    EXPECT_LE(populations(graph)[kLevels], 4u * 25);
}

// Cells far too small to be counted, and places further apart than floats of their size tell.
TEST(MeshLevels, AnySizeWillDo) {
    for (const float size : {1e-30f, 1e-6f, 1e6f, 1e18f}) {
        Sheets sheets;
        sheets.add({size, -size, 0}, {size, 0, 0}, {0, size, 0}, size / 20);
        for (const float cell : {1e-9f, 1.0f, 1e9f})
            expect_sound(make_mesh_graph(sheets.mesh, {.top_cell = cell}, 2));
    }
}

}  // namespace
}  // namespace chiaro
