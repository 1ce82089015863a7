// Shading between vertices: exact on linear functions, and without cracks.
#include "shading_cache/interpolate.h"

#include "shading_cache/cache_testing.h"

#include <algorithm>

namespace chiaro {
namespace {

using namespace tiny;

// RGB9E5 errs by up to half of 1/256 of the largest channel, at each vertex.
constexpr float kRounding = 0.5f / 256 * 1.01f;

// The fan's three weights sum to 1, none is negative, and they say where the point is.
TEST(FanPlace, WeightsAreBarycentric) {
    Rng rng(1);
    for (const bool quad : {true, false}) {
        const int n = quad ? 4 : 3;
        const Vec2 centre = quad ? Vec2(0.5f) : Vec2(1.0f / 3);
        for (int i = 0; i < 20'000; ++i) {
            Vec2 p = random_place(quad, rng);
            if (i % 10 == 0) p.x = 0;  // borders too
            if (i % 10 == 1) p.y = 0;
            if (i % 10 == 2) p = quad ? Vec2(1, p.y) : Vec2(p.x, 1 - p.x);
            const FanPlace f = fan_place(quad, p);
            ASSERT_TRUE(f.edge >= 0 && f.edge < n);
            EXPECT_NEAR(f.centre + f.a + f.b, 1, 1e-6f);
            EXPECT_GE(std::min({f.centre, f.a, f.b}), -1e-6f);
            const Vec2 a = node_place(quad, static_cast<Node>(f.edge));
            const Vec2 b = node_place(quad, static_cast<Node>((f.edge + 1) % n));
            EXPECT_NEAR(glm::length(f.centre * centre + f.a * a + f.b * b - p), 0, 1e-6f);
        }
    }
}

// A linear function of place is its own interpolation, on triangles and parallelograms, however
// divided.
TEST(Interpolate, ReproducesLinearFunctions) {
    Mat4 shear(1);
    shear[1].x = 0.4f;
    const auto linear = [](Vec3 p) {
        return Rgb(20 + 3 * p.x - 2 * p.y, 10 + p.x + p.y, 5 + 2 * p.y);
    };
    Rng rng(2);
    for (const bool triangles : {false, true})
        for (const SplitRule rule : {SplitRule::always_four, SplitRule::by_shape}) {
            const Scene scene = grid(3, 2, triangles, shear);
            const MeshGraphs graphs(scene, CoarserLevels::none, 1);
            ShadingCache cache(scene, graphs, {1}, rule);
            const auto roots = front_roots(cache);
            subdivide_at_random(cache, 200, rng);
            store_everywhere(cache, linear);
            for (int i = 0; i < 2000; ++i) {
                const std::uint32_t primitive = rng.below(static_cast<std::uint32_t>(roots.size()));
                const Vec2 uv = random_place(!triangles, rng);
                const LeafPlace at = leaf_at(cache, roots[primitive], uv);
                const Vec3 position =
                    surface_geometry(scene, {ObjectId{0}, primitive, uv.x, uv.y}).position;
                const Rgb expected = linear(position);
                const Rgb error = glm::abs(irradiance_at(cache, at.leaf, at.local) - expected);
                EXPECT_LE(max_component(error), kRounding * 33);  // 33: the largest value
            }
        }
}

// Channels are summed.
TEST(Interpolate, SumsTheChannels) {
    const Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {2}, SplitRule::always_four);
    const PatchId root = front_roots(cache)[0];
    for (const VertexId v : cache.patch(root).corners) {
        cache.store(v, 0, Rgb(2), 0, 1, 1);
        cache.store(v, 1, Rgb(1), 0, 1, 1);
    }
    EXPECT_EQ(irradiance_at(cache, root, {0.3f, 0.6f}), Rgb(3));
}

// The value of every point on an edge is the same from both its sides, at 1000 points of random
// meshes with random values: no cracks. Roots that share an edge: from s = 1 of one, s = 0 of the
// next.
TEST(Interpolate, HasNoCracksBetweenRoots) {
    Rng rng(3);
    for (const SplitRule rule : {SplitRule::always_four, SplitRule::by_shape}) {
        const Scene scene = grid(2, 1, false, stretched(3));
        const MeshGraphs graphs(scene, CoarserLevels::none, 1);
        ShadingCache cache(scene, graphs, {1}, rule);
        const auto roots = front_roots(cache);
        subdivide_at_random(cache, 100, rng);
        // The left side stays coarse at the edge, the right one halves it six times.
        for (int n = 0; n < 6; ++n) cache.subdivide(leaf_at(cache, roots[1], {0, 0.3f}).leaf);
        store_random(cache, rng);
        for (int i = 0; i < 1000; ++i) {
            const float t = rng.uniform();
            const LeafPlace left = leaf_at(cache, roots[0], {1, t});
            const LeafPlace right = leaf_at(cache, roots[1], {0, t});
            const Rgb apart = irradiance_at(cache, left.leaf, left.local) -
                              irradiance_at(cache, right.leaf, right.local);
            EXPECT_NEAR(glm::length(apart), 0, 0.01f)
                << t;  // of 100; rounding of t times the slope
        }
    }
}

// And between leaves below one root, quads and triangles: from a point on a leaf's edge to the leaf
// on the other side.
TEST(Interpolate, HasNoCracksBetweenLeaves) {
    Rng rng(4);
    for (const bool triangles : {false, true})
        for (const SplitRule rule : {SplitRule::always_four, SplitRule::by_shape}) {
            const Scene scene = grid(1, 1, triangles, stretched(2.5f));
            const MeshGraphs graphs(scene, CoarserLevels::none, 1);
            ShadingCache cache(scene, graphs, {1}, rule);
            const PatchId root = front_roots(cache)[0];
            subdivide_at_random(cache, 60, rng);
            store_random(cache, rng);
            int compared = 0;
            while (compared < 1000) {
                const LeafPlace start = leaf_at(cache, root, random_place(!triangles, rng));
                const int n = triangles ? 3 : 4;
                const int edge = static_cast<int>(rng.below(static_cast<std::uint32_t>(n)));
                const Vec2 a = node_place(!triangles, static_cast<Node>(edge));
                const Vec2 b = node_place(!triangles, static_cast<Node>((edge + 1) % n));
                const Vec2 centre = triangles ? Vec2(1.0f / 3) : Vec2(0.5f);
                const Vec2 on_edge = glm::mix(a, b, 0.01f + 0.98f * rng.uniform());
                const Vec2 p = cache.surface_uv(start.leaf, on_edge);
                const Vec2 beyond =
                    cache.surface_uv(start.leaf, on_edge + 1e-3f * (on_edge - centre));
                const bool outside =
                    std::min(beyond.x, beyond.y) < 0 ||
                    (triangles ? beyond.x + beyond.y : std::max(beyond.x, beyond.y)) > 1;
                if (outside) continue;  // the root's border
                // The way down to the other leaf, taken with the point on the edge itself.
                LeafPlace other = {root, p};
                Vec2 guide = beyond;
                while (!cache.patch(other.leaf).is_leaf()) {
                    const Split split = cache.patch(other.leaf).split;
                    const int child = child_at(split, guide);
                    guide = to_child(split, child, guide);
                    other.local = to_child(split, child, other.local);
                    other.leaf = offset_by(cache.patch(other.leaf).first_child, child);
                }
                ASSERT_NE(other.leaf, start.leaf);
                const Vec2 q = other.local;
                const float past = triangles ? std::min({q.x, q.y, 1 - q.x - q.y})
                                             : std::min({q.x, q.y, 1 - q.x, 1 - q.y});
                if (past < -1e-4f) continue;  // `beyond` lies past the corner of a small neighbour
                const Rgb apart = irradiance_at(cache, start.leaf, on_edge) -
                                  irradiance_at(cache, other.leaf, other.local);
                EXPECT_NEAR(glm::length(apart), 0, 0.05f);
                ++compared;
            }
        }
}

// At a vertex the interpolation is the vertex's value; in a quad's middle the mean of its corners.
TEST(Interpolate, PassesThroughTheVertices) {
    const Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId root = front_roots(cache)[0];
    for (int c = 0; c < 4; ++c)
        cache.store(cache.patch(root).corners[c], 0, Rgb(static_cast<float>(8 << c)), 0, 1, 1);
    for (int c = 0; c < 4; ++c)
        EXPECT_EQ(irradiance_at(cache, root, node_place(true, static_cast<Node>(c))),
                  Rgb(static_cast<float>(8 << c)));
    EXPECT_EQ(irradiance_at(cache, root, {0.5f, 0.5f}), Rgb((8 + 16 + 32 + 64) / 4.0f));
}

}  // namespace
}  // namespace chiaro
