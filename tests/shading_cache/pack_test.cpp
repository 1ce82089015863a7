// Deleting leaves the rest as it was, to the bit.
#include "shading_cache/age_out.h"
#include "shading_cache/cache_testing.h"
#include "shading_cache/interpolate.h"

namespace chiaro {
namespace {

using namespace tiny;

// All that two caches show and know is the same, from two patches down to where `after` has no
// children left.
void expect_same_tree(const ShadingCache& before, PatchId a, const ShadingCache& after, PatchId b) {
    const Patch& p = before.patch(a);
    const Patch& q = after.patch(b);
    ASSERT_EQ(p.corner_count(), q.corner_count());
    EXPECT_EQ(p.last_seen, q.last_seen);
    EXPECT_EQ(p.level, q.level);
    EXPECT_EQ(p.reflectance, q.reflectance);
    if (!q.is_leaf()) {
        EXPECT_EQ(p.refined_channels, q.refined_channels);
    }
    for (int i = 0; i < p.corner_count(); ++i) {
        const VertexId v = p.corners[i], w = q.corners[i];
        EXPECT_EQ(before.vertex(v).uv, after.vertex(w).uv);
        EXPECT_EQ(before.vertex(v).surface_side, after.vertex(w).surface_side);
        const Parents from = before.parents(v), to = after.parents(w);
        ASSERT_EQ(from.size(), to.size());
        for (std::size_t k = 0; k < from.size(); ++k) {
            EXPECT_EQ(from.whole_weight(k), to.whole_weight(k));
            EXPECT_EQ(before.vertex(from[k]).uv, after.vertex(to[k]).uv);
        }
        EXPECT_EQ(before.vertex(v).buried, after.vertex(w).buried);
        EXPECT_EQ(before.vertex(v).exposed, after.vertex(w).exposed);
        EXPECT_EQ(before.hollow(v, Shading::irradiance), after.hollow(w, Shading::irradiance));
        EXPECT_EQ(before.shown(v, 0).value, after.shown(w, 0).value);
        const Estimate *e = before.estimate(v, 0), *f = after.estimate(w, 0);
        ASSERT_EQ(e != nullptr, f != nullptr);
        if (e) {
            EXPECT_TRUE(e->mean == f->mean && e->variance == f->variance &&
                        e->surplus == f->surplus && e->samples == f->samples &&
                        e->shaded_at == f->shaded_at);
        }
    }
    if (q.is_leaf()) return;
    ASSERT_EQ(p.split, q.split);
    for (int c = 0; c < child_count(p.split); ++c)
        expect_same_tree(before, offset_by(p.first_child, c), after, offset_by(q.first_child, c));
}

// A cache with random values at half of its vertices.
struct Divided {
    Scene scene;
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache;
    std::vector<PatchId> roots;

    explicit Divided(std::uint64_t seed, bool triangles = false)
        : scene(grid(3, 2, triangles)), cache(scene, graphs, {1}, SplitRule::by_shape) {
        Rng rng(seed);
        roots = front_roots(cache);
        subdivide_at_random(cache, 300, rng);
        for (std::uint32_t v = 0; v < cache.vertices().size(); ++v)
            if (v < 12 || rng.below(2) == 0)
                cache.store(static_cast<VertexId>(v), 0,
                            50.0f * Rgb(rng.uniform(), rng.uniform(), rng.uniform()), rng.uniform(),
                            1 + rng.below(9), 1);
        // Some buried, some exposed, some refined: all of a record has something to lose.
        for (std::uint32_t v = 0; v < cache.vertices().size(); v += 7) {
            cache.mark_buried(static_cast<VertexId>(v));
            if (v % 2 == 0) cache.expose(static_cast<VertexId>(v));
        }
        for (Patch& p : cache.patches())
            if (!p.is_leaf()) p.refined_channels = static_cast<std::uint8_t>(rng.below(2));
        cache.resolve();
    }
    Divided(const Divided&) = delete;
    Divided& operator=(const Divided&) = delete;
};

// Without a collapse, packing changes nothing.
TEST(Pack, KeepsAllThatIsReached) {
    Divided d(1);
    const ShadingCache before = d.cache;
    d.cache.pack();
    EXPECT_EQ(d.cache.patches().size(), before.patches().size());
    EXPECT_EQ(d.cache.vertices().size(), before.vertices().size());
    for (const PatchId root : d.roots) expect_same_tree(before, root, d.cache, root);
    expect_consistent(d.cache);
    EXPECT_LE(d.cache.bytes(), before.bytes());
}

// Collapsing random patches leaves the rest bit-identical, with links, shared edges and welds.
TEST(Pack, LeavesTheRestAsItWas) {
    for (const bool triangles : {false, true}) {
        Divided d(2, triangles);
        const ShadingCache before = d.cache;
        Rng rng(3);
        for (int i = 0; i < 12; ++i) {
            const auto id = static_cast<PatchId>(rng.below(150));
            d.cache.collapse(id);
            EXPECT_TRUE(d.cache.patch(id).is_leaf());
        }
        d.cache.pack();
        EXPECT_LT(d.cache.patches().size(), before.patches().size());
        EXPECT_LT(d.cache.vertices().size(), before.vertices().size());
        expect_consistent(d.cache);
        const auto roots = front_roots(d.cache);
        for (std::size_t i = 0; i < roots.size(); ++i)
            expect_same_tree(before, d.roots[i], d.cache, roots[i]);
        // Carrying values down again finds nothing to change.
        const ShadingCache packed = d.cache;
        d.cache.resolve();
        for (const PatchId root : roots) expect_same_tree(packed, root, d.cache, root);
    }
}

// The picture of a part that shares no edge with what was deleted is the same to the bit.
TEST(Pack, KeepsThePictureElsewhere) {
    Divided d(4);
    const auto look = [&](const std::vector<PatchId>& roots) {
        std::vector<Rgb> values;
        Rng rng(5);
        for (int i = 0; i < 500; ++i) {
            const LeafPlace at = leaf_at(d.cache, roots[2], random_place(true, rng));
            values.push_back(irradiance_at(d.cache, at.leaf, at.local));
        }
        return values;
    };
    const std::vector<Rgb> shown = look(d.roots);
    d.cache.collapse(d.roots[0]);  // squares 0 and 2 of a row do not touch
    d.cache.collapse(d.roots[3]);
    d.cache.pack();
    EXPECT_EQ(look(front_roots(d.cache)), shown);
}

// An edge that one side gave up keeps the other side's midpoint, and divided anew shares it.
TEST(Pack, EdgesAreStillShared) {
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto roots = front_roots(cache);
    for (const PatchId root : roots) cache.subdivide(root);
    ASSERT_EQ(cache.vertices().size(), 6u + 5 + 4);
    cache.collapse(roots[0]);
    cache.pack();
    EXPECT_EQ(cache.vertices().size(), 6u + 5);
    const PatchId left = cache.root(ObjectId{0}, 0, true);
    cache.subdivide(left);
    EXPECT_EQ(cache.vertices().size(), 6u + 5 + 4);
    expect_consistent(cache);
}

// Corners of the mesh are still welded to roots that are made later.
TEST(Pack, CornersAreStillWelded) {
    const Scene scene = grid(3, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId first = cache.root(ObjectId{0}, 0, true);
    cache.subdivide(first);
    const PatchId second = cache.root(ObjectId{0}, 1, true);
    cache.collapse(first);
    cache.pack();
    EXPECT_EQ(cache.vertices().size(), 6u);
    EXPECT_EQ(cache.root(ObjectId{0}, 1, true), static_cast<PatchId>(index_of(second) - 4));
    cache.root(ObjectId{0}, 2, true);
    EXPECT_EQ(cache.vertices().size(), 8u);
    expect_consistent(cache);
}

// Given up before it is packed, a patch may be divided again.
TEST(Pack, ACollapsedPatchMayBeDividedAgain) {
    Divided d(6);
    const auto count = leaves(d.cache).size();
    d.cache.collapse(d.roots[0]);
    d.cache.subdivide(d.roots[0]);
    d.cache.pack();
    EXPECT_LT(leaves(d.cache).size(), count);
    expect_consistent(d.cache);
}

// With all children gone, the cache holds as many bytes as one that never had any.
TEST(Pack, GivesAllMemoryBack) {
    Divided d(7);
    const std::size_t full = d.cache.bytes();
    for (const PatchId root : d.roots) d.cache.collapse(root);
    d.cache.pack();
    EXPECT_EQ(d.cache.patches().size(), 6u);
    EXPECT_EQ(d.cache.vertices().size(), 12u);
    EXPECT_LT(d.cache.bytes(), full);
    ShadingCache fresh(d.scene, d.graphs, {1}, SplitRule::by_shape);
    front_roots(fresh);
    store_constant(fresh, Rgb(1));
    fresh.pack();
    EXPECT_EQ(d.cache.bytes(), fresh.bytes());
}

}  // namespace
}  // namespace chiaro
