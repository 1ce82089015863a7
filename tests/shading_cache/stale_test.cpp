// Estimates of the scene before an edit, against arithmetic.
#include "shading_cache/cache_testing.h"

namespace chiaro {
namespace {

using namespace tiny;

struct Corner {
    Scene scene = grid(1, 1);
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache{scene, graphs, {1}, SplitRule::always_four};
    PatchId root = cache.root(ObjectId{0}, 0, true);
    VertexId id = cache.patch(root).corners[0];

    Corner() = default;
    Corner(const Corner&) = delete;
    Corner& operator=(const Corner&) = delete;
    const Estimate& estimate() const { return *cache.estimate(id, 0); }
};

// Samples taken after an edit take the place of what was known before: none are mixed.
TEST(Stale, NewSamplesReplaceAStaleEstimate) {
    Corner c;
    c.cache.store(c.id, 0, Rgb(8), 0.25f, 1024, 1);
    c.cache.outdate(c.id, 0, 4);
    EXPECT_TRUE(c.estimate().stale);
    EXPECT_EQ(c.cache.shown(c.id, 0).value, Rgb(8));  // until there is something better

    c.cache.store(c.id, 0, Rgb(2), 0.5f, 32, 2);
    EXPECT_FALSE(c.estimate().stale);
    EXPECT_EQ(c.estimate().mean, Rgb(2));
    EXPECT_EQ(c.estimate().samples, 32u);
    EXPECT_EQ(static_cast<float>(c.estimate().variance), 0.5f);
    EXPECT_EQ(c.cache.shown(c.id, 0).value, Rgb(2));

    c.cache.store(c.id, 0, Rgb(4), 0.5f, 32, 3);
    EXPECT_EQ(c.estimate().mean, Rgb(3));
    EXPECT_EQ(c.estimate().samples, 64u);
}

// 1024 samples of variance 1/4 tell as much as 64 of variance 4, which is what an estimate is worth
// that may be off by 2; and as 256 of variance 1 once that turns out to be less.
TEST(Stale, AStaleEstimateIsWorthAsManySamplesAsWouldErrAsMuch) {
    Corner c;
    c.cache.store(c.id, 0, Rgb(8), 0.25f, 1024, 1);
    c.cache.outdate(c.id, 0, 3.75f);
    EXPECT_EQ(static_cast<float>(c.estimate().variance), 4);
    EXPECT_EQ(c.estimate().samples, 64u);
    c.cache.outdate(c.id, 0, 1);
    EXPECT_EQ(static_cast<float>(c.estimate().variance), 1);
    EXPECT_EQ(c.estimate().samples, 256u);
}

// What is not known cannot be stale.
TEST(Stale, NothingIsOutdatedWhereNothingIsKnown) {
    Corner c;
    c.cache.outdate(c.id, 0, 1);
    EXPECT_FALSE(c.cache.evaluated(c.id, 0));
}

// A midpoint whose estimate is given up shows the mean of the edge's ends, and is told of once.
TEST(Stale, WhatIsForgottenIsPredicted) {
    Corner c;
    for (const VertexId corner : c.cache.patch(c.root).corners)
        c.cache.store(corner, 0, Rgb(4), 0, 32, 1);
    const VertexId midpoint = c.cache.patch(c.cache.subdivide(c.root)).corners[1];
    c.cache.store(midpoint, 0, Rgb(1), 0, 32, 1);
    EXPECT_EQ(c.cache.shown(midpoint, 0).value, Rgb(1));
    c.cache.forget(midpoint, 1);
    EXPECT_EQ(c.cache.shown(midpoint, 0).value, Rgb(4));
    const std::vector<std::pair<VertexId, int>> told = {{midpoint, 0}};
    EXPECT_EQ(c.cache.take_forgotten(), told);
    c.cache.forget(midpoint, 1);
    EXPECT_TRUE(c.cache.take_forgotten().empty());
}

// An object and a mesh that are appended to the scene get roots behind all others, and patches take
// the reflectance that materials have now.
TEST(Stale, TheCacheFollowsWhatIsAddedToTheScene) {
    Scene scene = grid(1, 1);
    MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId old = cache.root(ObjectId{0}, 0, true);
    const PatchId child = cache.subdivide(old);
    scene.objects.push_back(scene.objects[0]);
    scene.materials[0].base_color = Rgb(1);
    const std::vector<MaterialId> repainted = {MaterialId{0}};
    cache.follow_scene(repainted);
    EXPECT_EQ(cache.patch(old).reflectance, 255);
    EXPECT_EQ(cache.patch(child).reflectance, 255);
    const PatchId added = cache.root(ObjectId{1}, 0, true);
    EXPECT_NE(added, old);
    EXPECT_EQ(index_of(cache.surface_point(cache.patch(added).corners[0]).object), 1u);
    EXPECT_EQ(cache.root(ObjectId{0}, 0, true), old);
}

}  // namespace
}  // namespace chiaro
