// Patches and the vertices that their division makes.
#include "shading_cache/cache_testing.h"

namespace chiaro {
namespace {

using namespace tiny;

Scene one_quad(Vec3 u, Vec3 v) {
    Scene scene;
    add_quad(scene, Vec3(0), u, v, add_material(scene, Rgb(0.5f)));
    return scene;
}
Scene one_triangle(Vec3 a, Vec3 b, Vec3 c) {
    Scene scene;
    Mesh mesh;
    mesh.positions = {a, b, c};
    mesh.primitives = {triangle(0, 1, 2, add_material(scene, Rgb(0.5f)))};
    add_object(scene, std::move(mesh));
    return scene;
}
Split split_of(const Scene& scene, SplitRule rule) {
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, rule);
    const PatchId root = cache.root(ObjectId{0}, 0, true);
    cache.subdivide(root);
    return cache.patch(root).split;
}

// Section 3: roots are made when first asked for, once.
TEST(Subdivide, RootsAreMadeOnce) {
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {2}, SplitRule::always_four);
    EXPECT_TRUE(cache.patches().empty());
    const PatchId root = cache.root(ObjectId{0}, 1, true);
    EXPECT_EQ(cache.root(ObjectId{0}, 1, true), root);
    EXPECT_EQ(cache.patches().size(), 1u);
    EXPECT_EQ(cache.vertices().size(), 4u);
    EXPECT_TRUE(cache.patch(root).is_root() && cache.patch(root).is_leaf());
    EXPECT_EQ(cache.surface_side(root), 2u);
}

// A quad in four makes 4 midpoints and a centre; a neighbour finds one midpoint made.
TEST(Subdivide, NeighboursShareTheMidpointOfTheirEdge) {
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto roots = front_roots(cache);
    EXPECT_EQ(cache.vertices().size(), 6u);
    cache.subdivide(roots[0]);
    EXPECT_EQ(cache.vertices().size(), 6u + 5);
    cache.subdivide(roots[1]);
    EXPECT_EQ(cache.vertices().size(), 6u + 5 + 4);
    expect_consistent(cache);
}

// A triangle in four makes 3 midpoints; its neighbour 2.
TEST(Subdivide, TrianglesShareMidpointsToo) {
    const Scene scene = grid(1, 1, true);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto roots = front_roots(cache);
    EXPECT_EQ(cache.vertices().size(), 4u);
    cache.subdivide(roots[0]);
    EXPECT_EQ(cache.vertices().size(), 4u + 3);
    cache.subdivide(roots[1]);
    EXPECT_EQ(cache.vertices().size(), 4u + 3 + 2);
    expect_consistent(cache);
}

// Evenly divided n times, a square has (2^n + 1)^2 vertices: none is made twice.
TEST(Subdivide, AnEvenGridHasEachVertexOnce) {
    const Scene scene = one_quad({1, 0, 0}, {0, 1, 0});
    for (const SplitRule rule : {SplitRule::always_four, SplitRule::by_shape}) {
        const MeshGraphs graphs(scene, CoarserLevels::none, 1);
        ShadingCache cache(scene, graphs, {1}, rule);
        cache.root(ObjectId{0}, 0, true);
        for (int n = 0; n < 5; ++n)
            for (const PatchId leaf : leaves(cache)) cache.subdivide(leaf);
        EXPECT_EQ(cache.vertices().size(), 33u * 33u);
    }
}

// Whatever the order of division, links agree, parents come first and no edge is doubled.
TEST(Subdivide, StaysConsistentUnderRandomDivision) {
    Rng rng(1);
    for (const bool triangles : {false, true})
        for (const SplitRule rule : {SplitRule::always_four, SplitRule::by_shape}) {
            const Scene scene = grid(3, 2, triangles, stretched(5));
            const MeshGraphs graphs(scene, CoarserLevels::none, 1);
            ShadingCache cache(scene, graphs, {2}, rule);
            front_roots(cache);
            subdivide_at_random(cache, 400, rng);
            expect_consistent(cache);
        }
}

// Patches longer than 1.5 are halved across by shape, and divided into four by the paper's rule.
TEST(Subdivide, LongPatchesAreHalvedAcross) {
    const Scene wide = one_quad({4, 0, 0}, {0, 1, 0});
    const Scene high = one_quad({1, 0, 0}, {0, 4, 0});
    const Scene near_square = one_quad({1.4f, 0, 0}, {0, 1, 0});
    EXPECT_EQ(split_of(wide, SplitRule::by_shape), Split::quad_across_s);
    EXPECT_EQ(split_of(high, SplitRule::by_shape), Split::quad_across_t);
    EXPECT_EQ(split_of(near_square, SplitRule::by_shape), Split::quad_in_four);
    for (const Scene* scene : {&wide, &high, &near_square})
        EXPECT_EQ(split_of(*scene, SplitRule::always_four), Split::quad_in_four);
}

TEST(Subdivide, LongTrianglesAreHalvedAtTheirLongestEdge) {
    const Vec3 left(-5, 0, 0), right(5, 0, 0), top(0, 1, 0);
    EXPECT_EQ(split_of(one_triangle(left, right, top), SplitRule::by_shape),
              Split::triangle_edge_01);
    EXPECT_EQ(split_of(one_triangle(top, left, right), SplitRule::by_shape),
              Split::triangle_edge_12);
    EXPECT_EQ(split_of(one_triangle(right, top, left), SplitRule::by_shape),
              Split::triangle_edge_20);
    EXPECT_EQ(split_of(one_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), SplitRule::by_shape),
              Split::triangle_in_four);
    EXPECT_EQ(split_of(one_triangle(left, right, top), SplitRule::always_four),
              Split::triangle_in_four);
}

// A strip of 64 to 1 halved six times is 64 squares: the shape is measured in the world, below any
// transform.
TEST(Subdivide, HalvingEndsInSquares) {
    const Scene scene = grid(1, 1, false, stretched(64));
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::by_shape);
    front_roots(cache);
    for (int n = 0; n < 6; ++n)
        for (const PatchId leaf : leaves(cache)) cache.subdivide(leaf);
    EXPECT_EQ(leaves(cache).size(), 64u);
    EXPECT_EQ(cache.vertices().size(), 2u * 65u);
    const PatchId square = leaves(cache).front();
    cache.subdivide(square);
    EXPECT_EQ(cache.patch(square).split, Split::quad_in_four);
}

// A child's corner on the surface is where its parent has the node.
TEST(Subdivide, SurfaceUvOfCornersComesFromTheParentsNodes) {
    const Scene scene = one_quad({1, 0, 0}, {0, 1, 0});
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId root = cache.root(ObjectId{0}, 0, true);
    const PatchId child = offset_by(cache.subdivide(root), 2);  // corners (.5, .5) to (1, 1)
    const PatchId grandchild = cache.subdivide(child);          // corners (.5, .5) to (.75, .75)
    EXPECT_EQ(cache.surface_uv(child, {0, 0}), Vec2(0.5f, 0.5f));
    EXPECT_EQ(cache.surface_uv(child, {1, 1}), Vec2(1, 1));
    EXPECT_EQ(cache.surface_uv(grandchild, {1, 1}), Vec2(0.75f, 0.75f));
    EXPECT_EQ(cache.child_index(child), 2);
    EXPECT_EQ(cache.child_index(grandchild), 0);
}

// Sample points are pulled 0.2 % from the border toward the centre of the patch that made them.
TEST(Subdivide, SamplePointsArePulledFromTheBorder) {
    const Scene scene = one_quad({2, 0, 0}, {0, 2, 0});
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId root = cache.root(ObjectId{0}, 0, true);
    const PatchId child = cache.subdivide(root);
    const auto expect_uv = [&](VertexId v, Vec2 uv) {
        EXPECT_NEAR(cache.vertex(v).uv.x, uv.x, 1e-6f);
        EXPECT_NEAR(cache.vertex(v).uv.y, uv.y, 1e-6f);
    };
    expect_uv(cache.patch(root).corners[0], {0.001f, 0.001f});
    expect_uv(cache.patch(root).corners[2], {0.999f, 0.999f});
    expect_uv(cache.patch(child).corners[1], {0.5f, 0.001f});
    expect_uv(cache.patch(child).corners[2], {0.5f, 0.5f});
    const Vec3 p =
        surface_geometry(scene, cache.surface_point(cache.patch(root).corners[0])).position;
    EXPECT_NEAR(glm::length(p - Vec3(0.002f, 0.002f, 0)), 0, 1e-6f);
}

// At any depth, sample points lie strictly within the primitive.
TEST(Subdivide, SamplePointsLieWithinThePrimitive) {
    Rng rng(3);
    for (const bool triangles : {false, true}) {
        const Scene scene = grid(2, 2, triangles);
        const MeshGraphs graphs(scene, CoarserLevels::none, 1);
        ShadingCache cache(scene, graphs, {1}, SplitRule::by_shape);
        front_roots(cache);
        subdivide_at_random(cache, 300, rng);
        for (const CacheVertex& v : cache.vertices()) {
            EXPECT_GT(std::min(v.uv.x, v.uv.y), 0);
            EXPECT_LT(triangles ? v.uv.x + v.uv.y : std::max(v.uv.x, v.uv.y), 1);
        }
    }
}

// The budget of 128 bytes a patch: with three channels, evaluated as often as in the built-in rooms
// after 15 s or oftener, the cache takes less than 112, which leaves 16 for the selector's trees,
// what it knows of meshes and polish.
TEST(Subdivide, APatchTakesLessThan112Bytes) {
    Rng rng(5);
    const Scene scene = grid(20, 20);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {.irradiance = 2, .glossy = 1}, SplitRule::by_shape);
    front_roots(cache);
    for (std::uint32_t i = 0; i < 15'000; ++i) cache.subdivide(PatchId{i});
    constexpr std::array<float, 3> kEvaluated = {0.9f, 0.35f, 0.1f};
    for (std::uint32_t v = 0; v < cache.vertices().size(); ++v)
        for (int c = 0; c < 3; ++c)
            if (rng.uniform() < kEvaluated[c]) cache.store(VertexId{v}, c, Rgb(1), 0, 32, 1);
    EXPECT_LT(static_cast<double>(cache.bytes()) / static_cast<double>(cache.patches().size()),
              112);
}

}  // namespace
}  // namespace chiaro
