// What vertices know and show, against arithmetic. Values are greys of powers of two where RGB9E5
// is exact.
#include "shading_cache/square.h"

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

// A square divided once: corners, midpoints and centre.
struct Square : tiny::Square {
    VertexId midpoint;  // of corners 0 and 1
    VertexId centre;

    explicit Square(int channels = 1) : tiny::Square({channels}) {
        const PatchId child = cache.subdivide(root);
        midpoint = cache.patch(child).corners[1];
        centre = cache.patch(child).corners[2];
    }
    void store_corners(std::array<float, 4> greys, float variance = 0) {
        for (int c = 0; c < 4; ++c) cache.store(corners[c], 0, Rgb(greys[c]), variance, 1, 1);
        cache.resolve();
    }
    Rgb shown(VertexId v, int channel = 0) const { return cache.shown(v, channel).value; }
};

// n1 samples of mean m1 and n2 of m2 have the mean (n1 m1 + n2 m2) / n, and the mean's variance is
// (n1^2 v1 + n2^2 v2) / n^2.
TEST(Values, BatchesAreMergedBySampleCounts) {
    Square s;
    s.cache.store(s.corners[0], 0, {4, 8, 0}, 0.5f, 32, 7);
    s.cache.store(s.corners[0], 0, {8, 0, 4}, 0.25f, 96, 9);
    const Estimate& e = *s.cache.estimate(s.corners[0], 0);
    EXPECT_EQ(e.samples, 128u);
    EXPECT_EQ(e.shaded_at, 9u);
    EXPECT_NEAR(glm::length(e.mean - Rgb(7, 2, 3)), 0, 1e-5f);
    EXPECT_NEAR(e.variance, (32 * 32 * 0.5f + 96 * 96 * 0.25f) / (128 * 128), 1e-6f);
}

// 32 batches of n samples and variance v are one of 32 n with v / 32.
TEST(Values, VarianceFallsAsOneOverTheSamples) {
    Square s;
    for (int i = 0; i < 32; ++i) s.cache.store(s.corners[0], 0, Rgb(1), 0.5f, 64, 1);
    EXPECT_EQ(s.cache.estimate(s.corners[0], 0)->samples, 2048u);
    // Kept in 16 bits, rounded at each of the 31 merges.
    EXPECT_NEAR(s.cache.estimate(s.corners[0], 0)->variance, 0.5f / 32, 0.03f * 0.5f / 32);
}

// What was not evaluated shows the parents' mean: two ends, or four corners.
TEST(Values, PredictionIsTheParentsMean) {
    Square s;
    s.store_corners({2, 6, 16, 8});
    EXPECT_FALSE(s.cache.evaluated(s.midpoint, 0));
    EXPECT_EQ(s.shown(s.midpoint), Rgb(4));
    EXPECT_EQ(s.shown(s.centre), Rgb(8));
    s.cache.store(s.midpoint, 0, Rgb(1), 0, 1, 1);
    EXPECT_EQ(s.shown(s.midpoint), Rgb(1));
    EXPECT_EQ(s.shown(s.centre), Rgb(8));  // its parents are the corners
}

// A vertex made after its parents were evaluated shows their mean at once.
TEST(Values, NewVerticesShowTheirPrediction) {
    Square s;
    s.store_corners({2, 2, 2, 2});
    const PatchId child = s.cache.patch(s.root).first_child;
    const PatchId grandchild = s.cache.subdivide(child);
    EXPECT_EQ(s.shown(s.cache.patch(grandchild).corners[2]), Rgb(2));
}

// One pass carries a change of the corners down through all levels: everything between equal
// corners is equal to them, ten levels down.
TEST(Values, ResolveCarriesCoarseToFine) {
    Square s;
    PatchId deep = s.cache.patch(s.root).first_child;
    for (int level = 0; level < 10; ++level) deep = offset_by(s.cache.subdivide(deep), 2);
    s.store_corners({16, 16, 16, 16});
    for (std::uint32_t v = 0; v < s.cache.vertices().size(); ++v)
        EXPECT_EQ(s.shown(static_cast<VertexId>(v)), Rgb(16));
}

// The display's form errs by at most half a step of 1/256 of the largest channel.
TEST(Values, ShownValuesAreRoundedToRgb9e5) {
    Square s;
    Rng rng(1);
    for (int i = 0; i < 2000; ++i) {
        const Rgb value =
            std::exp2(20 * rng.uniform() - 6) * Rgb(rng.uniform(), rng.uniform(), rng.uniform());
        Square fresh;
        fresh.cache.store(fresh.corners[0], 0, value, 0, 1, 1);
        EXPECT_EQ(fresh.cache.estimate(fresh.corners[0], 0)->mean, value);  // kept in full
        EXPECT_LE(max_component(glm::abs(fresh.shown(fresh.corners[0]) - value)),
                  max_component(value) * (0.5f / 256) * 1.001f);
    }
}

// Sunlight and starlight are shown alike: steps are at most 0.4 % from 1e-6 to 1e10 lux, and what
// is there stays to 0.4 % when something a million times brighter comes.
TEST(Values, ShowsAnyBrightness) {
    for (const float lux : {1e-6f, 3e-3f, 1.0f, 65500.0f, 1.2e5f, 1e10f}) {
        Square fresh;
        fresh.cache.store(fresh.corners[0], 0, Rgb(lux), 0, 1, 1);
        EXPECT_NEAR(fresh.shown(fresh.corners[0]).g / lux, 1, 0.004f);
        fresh.cache.store(fresh.corners[1], 0, Rgb(lux * 1e6f), 0, 1, 1);
        EXPECT_NEAR(fresh.shown(fresh.corners[0]).g / lux, 1, 0.004f);
        EXPECT_NEAR(fresh.shown(fresh.corners[1]).g / (lux * 1e6f), 1, 0.004f);
    }
}

// The surplus is what the prediction missed, less three times the noise of both: miss 6, variances
// 1 and (1 + 1) / 4, so sqrt(36 - 4.5).
TEST(Values, SurplusIsTheMissLessTheNoise) {
    Square s;
    s.store_corners({2, 2, 2, 2}, 1);
    s.cache.store(s.midpoint, 0, Rgb(8), 1, 1, 1);
    EXPECT_NEAR(s.cache.estimate(s.midpoint, 0)->surplus, std::sqrt(36 - 3 * 1.5f), 0.03f);
}

// A miss within the noise is no surplus of its own; a part of the parents' is what is left, and of
// that nothing where they have none.
TEST(Values, AMissWithinTheNoiseIsNoSurplus) {
    Square s;
    s.store_corners({2, 2, 2, 2}, 1);
    const Estimate& corner = *s.cache.estimate(s.corners[0], 0);
    EXPECT_EQ(corner.surplus, Estimate::kUnknown);  // nothing predicted it
    const float of_corner = s.cache.surplus(s.corners[0], 0);
    EXPECT_GT(of_corner, 0);
    EXPECT_LT(of_corner, 2);                        // a part of all light there
    s.cache.store(s.midpoint, 0, Rgb(4), 1, 1, 1);  // 2^2 < 3 x 1.5
    EXPECT_GT(s.cache.estimate(s.midpoint, 0)->surplus, 0);
    EXPECT_NEAR(s.cache.estimate(s.midpoint, 0)->surplus, of_corner / 16, 0.01f * of_corner);

    Square dark;
    dark.store_corners({0, 0, 0, 0}, 1);
    dark.cache.store(dark.midpoint, 0, Rgb(2), 1, 1, 1);
    EXPECT_EQ(dark.cache.estimate(dark.midpoint, 0)->surplus, 0);
}

// Of four replicates that all missed what is bright, the variance is small and the miss seems sure.
// Further samples that find it take the surplus back.
TEST(Values, FurtherSamplesTellWhatOfTheSurplusWasNoise) {
    Square s;
    s.store_corners({8, 8, 8, 8});
    s.cache.store(s.midpoint, 0, Rgb(2), 0, 128, 1);
    EXPECT_NEAR(s.cache.estimate(s.midpoint, 0)->surplus, 6, 0.03f);
    s.cache.store(s.midpoint, 0, Rgb(12), 0, 128, 2);
    EXPECT_NEAR(s.cache.estimate(s.midpoint, 0)->surplus, 1, 0.03f);
}

// They never raise it: once the parents' light has changed too, it says nothing of what lies
// between.
TEST(Values, FurtherSamplesDoNotRaiseTheSurplus) {
    Square s;
    s.store_corners({8, 8, 8, 8});
    s.cache.store(s.midpoint, 0, Rgb(7), 0, 128, 1);
    s.cache.store(s.midpoint, 0, Rgb(1), 0, 128, 2);
    EXPECT_NEAR(s.cache.estimate(s.midpoint, 0)->surplus, 1, 0.01f);
}

// Channels have values of their own; the total is their sum.
TEST(Values, ChannelsAreIndependent) {
    Square s(3);
    for (const VertexId v : s.corners)
        for (int c = 0; c < 3; ++c) s.cache.store(v, c, Rgb(static_cast<float>(1 << c)), 0, 1, 1);
    s.cache.resolve();
    s.cache.store(s.centre, 1, Rgb(32), 0, 1, 1);
    EXPECT_FALSE(s.cache.evaluated(s.centre, 0));
    EXPECT_EQ(s.shown(s.centre, 0), Rgb(1));
    EXPECT_EQ(s.shown(s.centre, 1), Rgb(32));
    EXPECT_EQ(s.cache.shown_total(s.centre).value, Rgb(1 + 32 + 4));
}

// Glossy radiance is no part of the irradiance, and is given up for another eye; the rest stays.
TEST(Values, GlossyChannelsAreTheEyesOwn) {
    const Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {.irradiance = 2, .glossy = 1}, SplitRule::always_four);
    const PatchId root = cache.root(ObjectId{0}, 0, true);
    cache.subdivide(root);
    cache.patch(root).refined_channels = 7;
    for (std::uint32_t v = 0; v < cache.vertices().size(); ++v)
        for (int c = 0; c < 3; ++c)
            cache.store(static_cast<VertexId>(v), c, Rgb(std::exp2(static_cast<float>(c))), 0, 1,
                        1);
    const VertexId corner = cache.patch(root).corners[0];
    EXPECT_EQ(cache.shown_total(corner).value, Rgb(1 + 2));
    EXPECT_EQ(cache.shown_total(corner, Shading::glossy).value, Rgb(4));

    cache.forget_glossy();
    cache.resolve();
    EXPECT_EQ(cache.shown_total(corner).value, Rgb(1 + 2));
    EXPECT_EQ(cache.shown_total(corner, Shading::glossy).value, Rgb(0));
    EXPECT_FALSE(cache.evaluated(corner, 2));
    EXPECT_EQ(cache.patch(root).refined_channels, 3);
    cache.store(corner, 2, Rgb(8), 0, 1, 2);
    EXPECT_EQ(cache.shown(corner, 2).value, Rgb(8));
}

}  // namespace
}  // namespace chiaro
