// Which corners of a mesh are one vertex of its graph.
#include "shading_cache/mesh_graph.h"

#include "shading_cache/cache_testing.h"
#include "shading_cache/fold.h"

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

std::size_t vertices_of(Mesh mesh) {
    order_primitives(mesh);
    return make_mesh_graph(mesh, {}, 1).vertex_count();
}
std::size_t vertices_of_fold(float degrees, bool normals) {
    return vertices_of(folded(degrees, normals, MaterialId{0}, MaterialId{0}));
}

// Three quads, then two triangles.
Mesh of_both_kinds() {
    Mesh mesh = grid(3, 1).meshes[0];
    const MaterialId material = mesh.primitives[0].material;
    mesh.positions.push_back({4, 0, 0});
    mesh.positions.push_back({4, 1, 0});
    mesh.primitives.push_back(triangle(3, 8, 9, material));
    mesh.primitives.push_back(triangle(3, 9, 7, material));
    return mesh;
}

TEST(MeshCorner, NumbersAndCornersAreInverse) {
    const Mesh mesh = of_both_kinds();
    ASSERT_EQ(corner_count(mesh), 3u * 4 + 2 * 3);
    std::uint32_t index = 0;
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p)
        for (int c = 0; c < mesh.primitives[p].corner_count(); ++c, ++index) {
            EXPECT_EQ(corner_index(mesh, {p, c}), index);
            EXPECT_EQ(corner_at(mesh, index).primitive, p);
            EXPECT_EQ(corner_at(mesh, index).corner, c);
        }
    EXPECT_EQ(index, corner_count(mesh));
}

// A grid of n x m squares has (n + 1) (m + 1) vertices; the two of either end of two squares that
// meet are one.
TEST(MeshGraph, CornersOfACoplanarNeighbourAreOneVertex) {
    EXPECT_EQ(vertices_of(grid(2, 1).meshes[0]), 6u);
    EXPECT_EQ(vertices_of(grid(7, 5, true).meshes[0]), 48u);
    EXPECT_EQ(vertices_of_fold(0, false), 6u);
    EXPECT_EQ(vertices_of_fold(0, true), 6u);
}

TEST(MeshGraph, ACreaseOfNinetyDegreesStaysSharp) {
    EXPECT_EQ(vertices_of_fold(90, false), 8u);
    EXPECT_EQ(vertices_of_fold(90, true), 8u);
    EXPECT_EQ(vertices_of(box_mesh(Vec3(0), Vec3(1), MaterialId{0}, false)), 24u);
}

// Normals of the file within 16 degrees are one smooth surface; a flat face ends at any crease that
// shows (1 degree).
TEST(MeshGraph, SmoothNormalsAreJoinedUpToSixteenDegrees) {
    EXPECT_EQ(vertices_of_fold(15, true), 6u);
    EXPECT_EQ(vertices_of_fold(17, true), 8u);
    EXPECT_EQ(vertices_of_fold(15, false), 8u);
    EXPECT_EQ(vertices_of_fold(0.5f, false), 6u);
}

TEST(MeshGraph, OtherMaterialsStayApart) {
    EXPECT_EQ(vertices_of(folded(0, false, MaterialId{0}, MaterialId{1})), 8u);
}

TEST(MeshGraph, SignedZeroIsOnePlace) {
    Mesh mesh = folded(0, false, MaterialId{0}, MaterialId{0});
    mesh.positions[4] = {-0.0f, -0.0f, -0.0f};
    EXPECT_EQ(vertices_of(mesh), 6u);
}

// Normals of a file whose winding is wrong point into the surface: both are put on its front.
TEST(MeshGraph, NormalsAreTakenOnTheFront) {
    Mesh mesh = folded(0, true, MaterialId{0}, MaterialId{0});
    for (std::size_t i = 4; i < 8; ++i) mesh.normals[i] = -mesh.normals[i];
    EXPECT_EQ(vertices_of(mesh), 6u);
}

// A quad without normals that is bent along its diagonal: corner 2 has the normal of its own half.
TEST(MeshGraph, CornersOfABentQuadHaveTheNormalOfTheirHalf) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}, {2, 1, 2}};
    mesh.primitives = {quad(0, 1, 2, 3, MaterialId{0}),
                       triangle(1, 4, 2, MaterialId{0})};  // in the plane of the second half
    order_primitives(mesh);
    const MeshGraph graph = make_mesh_graph(mesh, {}, 1);
    EXPECT_EQ(graph.vertex_of_corner[corner_index(mesh, {0, 2})],
              graph.vertex_of_corner[corner_index(mesh, {1, 2})]);
    EXPECT_NE(graph.vertex_of_corner[corner_index(mesh, {0, 1})],
              graph.vertex_of_corner[corner_index(mesh, {1, 0})]);
}

TEST(MeshGraph, AVertexIsSampledAtItsFirstCorner) {
    const Mesh mesh = of_both_kinds();
    const MeshGraph graph = make_mesh_graph(mesh, {}, 2);
    EXPECT_EQ(graph.vertex_count(), 10u);
    std::vector<std::uint32_t> first(graph.vertex_count(), 0xffff'ffff);
    for (std::uint32_t i = 0; i < corner_count(mesh); ++i)
        first[graph.vertex_of_corner[i]] = std::min(first[graph.vertex_of_corner[i]], i);
    EXPECT_EQ(graph.corner_of_vertex, first);
}

// Points that share a place, in an order that has nothing to do with where they are.
TEST(MeshGraph, IsTheSameOnAnyNumberOfThreads) {
    const Mesh shared = grid(200, 200, true).meshes[0];
    Mesh mesh;
    Rng rng(1);
    for (std::uint32_t i = 0; i < shared.primitives.size(); ++i) {
        mesh.primitives.push_back(shared.primitives[i]);
        std::swap(mesh.primitives.back(), mesh.primitives[rng.below(i + 1)]);
    }
    for (Primitive& p : mesh.primitives)
        for (int c = 0; c < 3; ++c) {
            mesh.positions.push_back(shared.positions[p.corners[c]]);
            p.corners[c] = static_cast<std::uint32_t>(mesh.positions.size() - 1);
        }
    const MeshGraph one = make_mesh_graph(mesh, {.top_cell = 20}, 1);
    EXPECT_EQ(one.vertex_count(), 201u * 201);
    for (const int threads : {2, 7}) {
        const MeshGraph many = make_mesh_graph(mesh, {.top_cell = 20}, threads);
        EXPECT_EQ(many.vertex_of_corner, one.vertex_of_corner);
        EXPECT_EQ(many.corner_of_vertex, one.corner_of_vertex);
        EXPECT_EQ(many.level, one.level);
        EXPECT_EQ(many.first_parent, one.first_parent);
        EXPECT_EQ(many.parents, one.parents);
        EXPECT_EQ(many.weights, one.weights);
    }
}

TEST(MeshGraph, NoTopCellIsNoCoarserLevel) {
    const MeshGraph graph = make_mesh_graph(grid(9, 9).meshes[0], {}, 1);
    EXPECT_EQ(graph.level, std::vector<std::uint8_t>(100, 0));
    EXPECT_EQ(graph.first_parent, std::vector<std::uint32_t>(101, 0));
    EXPECT_TRUE(graph.parents.empty());
}

TEST(MeshGraph, AMeshWithoutPrimitivesHasNoVertices) {
    EXPECT_EQ(vertices_of(Mesh{}), 0u);
}

}  // namespace
}  // namespace chiaro
