// Vertices inside solids know no light and must not darken what is around them.
#include "shading_cache/interpolate.h"
#include "shading_cache/square.h"

namespace chiaro {
namespace {

using namespace tiny;

struct Square : tiny::Square {
    explicit Square(int channels = 1) : tiny::Square({channels}) {}

    void store_corners(float grey) {
        for (const VertexId v : corners) cache.store(v, 0, Rgb(grey), 0, 1, 1);
    }
};

// A buried midpoint shows what its parents predict, its own darkness never.
TEST(Buried, TakesTheParentsPrediction) {
    Square s;
    s.store_corners(8);
    const VertexId midpoint = s.cache.patch(s.cache.subdivide(s.root)).corners[1];
    s.cache.store(midpoint, 0, Rgb(0), 0, 16, 1);
    EXPECT_EQ(s.cache.shown(midpoint, 0).value, Rgb(0));
    s.cache.mark_buried(midpoint);
    EXPECT_EQ(s.cache.shown(midpoint, 0).value, Rgb(8));
    EXPECT_EQ(s.cache.shown(midpoint, 0).weight, 1);
    s.cache.resolve();
    EXPECT_EQ(s.cache.shown(midpoint, 0).value, Rgb(8));
}

// What a buried parent predicts is its own parents' light, from twice as far: a wall's vertices
// above a skirting take after those of the wall, not after what is interpolated behind the
// skirting.
TEST(Buried, TellsNothingWhereAnotherParentIsLit) {
    Square s;
    for (int c = 0; c < 4; ++c) s.cache.store(s.corners[c], 0, Rgb(c < 2 ? 8.0f : 64.0f), 0, 1, 1);
    const Patch divided = s.cache.patch(s.cache.subdivide(s.root));
    const VertexId midpoint = divided.corners[1], centre = divided.corners[2];
    s.cache.store(midpoint, 0, Rgb(8), 0, 1, 1);
    s.cache.store(centre, 0, Rgb(0), 0, 1, 1);
    s.cache.mark_buried(centre);
    EXPECT_EQ(s.cache.shown(centre, 0).value, Rgb(36));
    const VertexId between =
        s.cache.patch(s.cache.subdivide(s.cache.patch(s.root).first_child)).corners[2];
    s.cache.resolve();
    EXPECT_EQ(s.cache.parents(between).size(), 4u);
    EXPECT_LT(luminance(s.cache.shown(between, 0).value), 36);
    s.cache.store(s.cache.parents(between)[3], 0, Rgb(8), 0, 1, 1);
    s.cache.resolve();
    EXPECT_EQ(s.cache.shown(between, 0).value, Rgb(8));
}

// A buried corner of the mesh has no parents: it is hollow and leaves the interpolation, whose
// other weights are scaled up. Equal light at the other corners is then equal light everywhere.
TEST(Buried, HollowCornersLeaveTheInterpolation) {
    for (int buried = 1; buried <= 3; ++buried) {
        Square s;
        s.store_corners(8);
        for (int c = 0; c < buried; ++c) {
            s.cache.store(s.corners[c], 0, Rgb(0), 0, 1000, 1);
            s.cache.mark_buried(s.corners[c]);
            EXPECT_EQ(s.cache.shown(s.corners[c], 0).weight, 0);
        }
        EXPECT_EQ(s.cache.buried_corners(s.cache.patch(s.root)), buried);
        Rng rng(1);
        for (int i = 0; i < 1000; ++i) {
            const Vec2 p(0.001f + 0.998f * rng.uniform(), 0.001f + 0.998f * rng.uniform());
            EXPECT_NEAR(irradiance_at(s.cache, s.root, p).g, 8, 1e-4f);
        }
        // Nor do they enter predictions.
        const VertexId centre = s.cache.patch(s.cache.subdivide(s.root)).corners[2];
        EXPECT_EQ(s.cache.shown(centre, 0).value, Rgb(8));
    }
}

// Between hollow parents a vertex is hollow until it is evaluated itself.
TEST(Buried, HollownessIsInheritedUntilLightIsFound) {
    Square s;
    s.store_corners(8);
    s.cache.mark_buried(s.corners[0]);
    s.cache.mark_buried(s.corners[1]);
    const VertexId midpoint = s.cache.patch(s.cache.subdivide(s.root)).corners[1];
    EXPECT_EQ(s.cache.shown(midpoint, 0).weight, 0);
    s.cache.store(midpoint, 0, Rgb(4), 0, 1, 1);
    EXPECT_EQ(s.cache.shown(midpoint, 0).weight, 1);
    EXPECT_EQ(s.cache.shown(midpoint, 0).value, Rgb(4));
}

// A vertex among buried ones of which direct light alone is known is dark, not lit by the half of
// its light: it counts once the other half is known too.
TEST(Buried, HalfOfTheLightIsNoLight) {
    Square s(2);
    for (const VertexId v : s.corners)
        for (int c = 0; c < 2; ++c) s.cache.store(v, c, Rgb(c == 0 ? 2.0f : 8.0f), 0, 1, 1);
    s.cache.mark_buried(s.corners[0]);
    s.cache.mark_buried(s.corners[1]);
    const PatchId child = s.cache.subdivide(s.root);
    const VertexId midpoint = s.cache.patch(child).corners[1];
    s.cache.store(midpoint, 0, Rgb(2), 0, 1, 1);
    s.cache.resolve();
    EXPECT_EQ(s.cache.shown_total(midpoint).weight, 0);
    EXPECT_EQ(irradiance_at(s.cache, child, {0.9f, 0.1f}), Rgb(2 + 8));
    s.cache.store(midpoint, 1, Rgb(8), 0, 1, 1);
    EXPECT_EQ(s.cache.shown_total(midpoint).value, Rgb(2 + 8));
    EXPECT_EQ(s.cache.shown_total(midpoint).weight, 1);
}

// What a vertex was found to get in one channel predicts that channel, whatever the others know:
// surplus is reckoned against it before they are evaluated.
TEST(Buried, HalfOfTheLightPredictsThatHalf) {
    Square s(2);
    s.store_corners(8);
    EXPECT_EQ(s.cache.shown_total(s.corners[0]).weight, 0);
    const VertexId midpoint = s.cache.patch(s.cache.subdivide(s.root)).corners[1];
    EXPECT_EQ(s.cache.shown(midpoint, 0).value, Rgb(8));
    s.cache.store(midpoint, 0, Rgb(9), 0, 1, 1);
    EXPECT_EQ(s.cache.estimate(midpoint, 0)->surplus, 1);
}

// Metal has gloss alone: that nothing is known of irradiance there does not matter to it.
TEST(Buried, GlossIsKnownWithoutIrradiance) {
    Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {.irradiance = 2, .glossy = 1}, SplitRule::always_four);
    const PatchId root = cache.root(ObjectId{0}, 0, true);
    for (const VertexId v : cache.patch(root).corners) cache.store(v, 2, Rgb(3), 0, 1, 1);
    EXPECT_EQ(glossy_at(cache, root, {0.3f, 0.4f}), Rgb(3));
    EXPECT_EQ(cache.shown_total(cache.patch(root).corners[0]).weight, 0);
}

// If nothing is known the picture is black, not undefined.
TEST(Buried, AllHollowIsBlack) {
    Square s;
    EXPECT_EQ(irradiance_at(s.cache, s.root, {0.3f, 0.4f}), Rgb(0));
    s.store_corners(8);
    for (const VertexId v : s.corners) s.cache.mark_buried(v);
    EXPECT_EQ(irradiance_at(s.cache, s.root, {0.3f, 0.4f}), Rgb(0));
}

// On an edge both of whose ends are hollow, the patch's other corners are what is known.
TEST(Buried, AnEdgeOfHollowEndsShowsTheCentre) {
    Square s;
    s.store_corners(8);
    s.cache.mark_buried(s.corners[0]);
    s.cache.mark_buried(s.corners[1]);
    EXPECT_EQ(irradiance_at(s.cache, s.root, {0.3f, 0}), Rgb(8));
    EXPECT_EQ(irradiance_at(s.cache, s.root, {0.3f, 1e-6f}), Rgb(8));
}

// What more samples tell brings a buried vertex back, and may bury it again.
TEST(Buried, IsNotForGood) {
    Square s;
    s.store_corners(8);
    s.cache.mark_buried(s.corners[0]);
    s.cache.unmark_buried(s.corners[0]);
    EXPECT_EQ(s.cache.shown(s.corners[0], 0).weight, 1);
    s.cache.mark_buried(s.corners[0]);
    EXPECT_EQ(s.cache.shown(s.corners[0], 0).weight, 0);
}

// A vertex that is in view after all gets its estimate back, and is not buried again.
TEST(Buried, ExposeBringsBackForGood) {
    Square s(2);
    s.store_corners(8);
    s.cache.store(s.corners[0], 1, Rgb(2), 0, 1, 1);
    s.cache.mark_buried(s.corners[0]);
    EXPECT_EQ(s.cache.shown_total(s.corners[0]).weight, 0);
    s.cache.expose(s.corners[0]);
    EXPECT_EQ(s.cache.shown_total(s.corners[0]).value, Rgb(8 + 2));
    EXPECT_EQ(s.cache.shown_total(s.corners[0]).weight, 1);
    s.cache.mark_buried(s.corners[0]);
    EXPECT_FALSE(s.cache.vertex(s.corners[0]).buried);
    EXPECT_EQ(s.cache.shown_total(s.corners[0]).value, Rgb(8 + 2));
}

// A vertex is dark when all channels were evaluated and none has found light; one that has is
// enough.
TEST(Buried, OneLitChannelIsEnoughNotToBeDark) {
    Square s(2);
    EXPECT_FALSE(s.cache.dark(s.corners[0]));
    s.cache.store(s.corners[0], 0, Rgb(0), 0, 1, 1);
    EXPECT_FALSE(s.cache.dark(s.corners[0]));
    s.cache.store(s.corners[0], 1, Rgb(0), 0, 1, 1);
    EXPECT_TRUE(s.cache.dark(s.corners[0]));
    s.cache.store(s.corners[0], 1, Rgb(1, 0, 0), 0, 1, 1);
    EXPECT_FALSE(s.cache.dark(s.corners[0]));
}

}  // namespace
}  // namespace chiaro
