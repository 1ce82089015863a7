// Bicubic patches as roots of the cache: one graph over their edges, divided in (u, v).
#include "base/random.h"
#include "scene/curved_shapes.h"
#include "scene/shapes.h"
#include "shading_cache/cache_testing.h"
#include "shading_cache/interpolate.h"
#include "shading_cache/shading_cache.h"

#include <gtest/gtest.h>

#include <set>

namespace chiaro {
namespace {

using tiny::leaf_at;
using tiny::LeafPlace;

Scene ball() {
    Scene scene;
    const MaterialId m = tiny::add_material(scene, Rgb(0.5f));
    Mesh mesh;
    add(mesh, curved_sphere(1), m);
    tiny::add_object(scene, std::move(mesh));
    return scene;
}

struct Ball {
    Scene scene = ball();
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache{scene, graphs, {1}, SplitRule::by_shape};
    std::vector<PatchId> roots;

    Ball() {
        for (std::uint32_t p = 0; p < 8; ++p) roots.push_back(cache.root(ObjectId{0}, p, true));
    }
};

// Eight octants have six corners: two poles, which four patches each share, and four on the
// equator.
TEST(CurvedRoots, CornersAreShared) {
    Ball b;
    EXPECT_EQ(b.cache.vertices().size(), 6u);
    std::set<VertexId> corners;
    for (const PatchId root : b.roots) {
        std::set<VertexId> own;
        for (const VertexId v : b.cache.patch(root).corners) own.insert(v);
        EXPECT_EQ(own.size(), 3u);  // one side is collapsed into a pole
        corners.insert(own.begin(), own.end());
    }
    EXPECT_EQ(corners.size(), 6u);
}

// However deep patches are divided, every vertex lies on the true sphere, nobody's midpoint is made
// twice, and a leaf's corners are as near to it as (u, v) say.
TEST(CurvedRoots, VerticesLieOnTheSurfaceAtAnyDepth) {
    Ball b;
    Rng rng(1);
    for (int k = 0; k < 400; ++k) {
        PatchId id = b.roots[rng.below(8)];
        while (!b.cache.patch(id).is_leaf())
            id = offset_by(b.cache.patch(id).first_child,
                           static_cast<int>(rng.below(
                               static_cast<std::uint32_t>(child_count(b.cache.patch(id).split)))));
        if (b.cache.patch(id).divisible()) b.cache.subdivide(id);
    }
    std::set<std::pair<VertexId, VertexId>> edges;
    for (std::size_t i = 0; i < b.cache.vertices().size(); ++i) {
        const auto id = static_cast<VertexId>(i);
        const SurfaceGeometry g = surface_geometry(b.scene, b.cache.surface_point(id));
        EXPECT_NEAR(glm::length(g.position), 1, 1e-6f);
        EXPECT_GT(glm::dot(g.geometric_normal, g.position), 0.9999f);
        const auto parents = b.cache.parents(id);
        if (parents.size() != 2) continue;
        EXPECT_TRUE(edges.insert(std::minmax({parents[0], parents[1]})).second);
    }
}

// The value at every point of an edge is the same from both of its patches: no cracks in shading,
// at the equator or along a meridian.
TEST(CurvedRoots, ShadingHasNoCracks) {
    Ball b;
    Rng rng(2);
    for (int k = 0; k < 300; ++k) {
        PatchId id = b.roots[rng.below(4)];  // the other patches stay coarser
        while (!b.cache.patch(id).is_leaf())
            id = offset_by(b.cache.patch(id).first_child,
                           static_cast<int>(rng.below(
                               static_cast<std::uint32_t>(child_count(b.cache.patch(id).split)))));
        if (b.cache.patch(id).divisible()) b.cache.subdivide(id);
    }
    for (std::size_t i = 0; i < b.cache.vertices().size(); ++i)
        b.cache.store(static_cast<VertexId>(i), 0, 100.0f * Rgb(rng.uniform()), 0, 32, 1);
    b.cache.resolve();
    // Quarters are pairs, the lower octant first: patch 2 q runs up to the equator, 2 q + 1 from
    // there; quarter q + 1 goes on where quarter q ends.
    const auto value = [&](std::uint32_t root, Vec2 uv) {
        const LeafPlace place = leaf_at(b.cache, b.roots[root], uv);
        return luminance(irradiance_at(b.cache, place.leaf, place.local));
    };
    for (int k = 0; k < 1000; ++k) {
        const float t = rng.uniform();
        for (std::uint32_t q = 0; q < 4; ++q) {
            EXPECT_NEAR(value(2 * q, {t, 1}), value(2 * q + 1, {t, 0}), 0.02f) << t;
            EXPECT_NEAR(value(2 * q, {1, t}), value((2 * q + 2) % 8, {0, t}), 0.02f) << t;
        }
    }
}

}  // namespace
}  // namespace chiaro
