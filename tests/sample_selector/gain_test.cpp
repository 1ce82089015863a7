// What a patch promises: refinement where the surplus is, samples where the noise is, nothing out
// of view.
#include "sample_selector/gain.h"

#include "sample_selector/gain_settings.h"
#include "shading_cache/dense_grid.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

using namespace tiny;

// A square of which `fragments` are in view, and its midpoints evaluated.
struct Square {
    Scene scene = grid(1, 1);
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache;
    PatchId root;
    std::array<VertexId, 4> corners;
    Rng rng{1};

    explicit Square(int fragments) : cache(scene, graphs, {1}, SplitRule::always_four) {
        root = cache.root(ObjectId{0}, 0, true);
        corners = cache.patch(root).corners;
        IdMap map = random_map(cache, {root}, fragments, rng);
        for (Fragment& f : map.fragments) f.reflectance = Rgb(alone());
        attach(cache, map, 1);
    }
    Square(const Square&) = delete;
    Square& operator=(const Square&) = delete;

    void store(std::array<float, 4> greys, float variance) {
        for (int c = 0; c < 4; ++c) cache.store(corners[c], 0, Rgb(greys[c]), variance, 64, 1);
    }
    /// Of a pixel that the square fills.
    float alone() const { return cache.patch(root).reflectance / 255.0f / kPi; }
    Gain gain() const { return chiaro::gain(cache, root, 0, settings()); }
};

TEST(Gain, IsZeroOutOfView) {
    Square s(0);
    s.store({1, 9, 1, 9}, 5);
    EXPECT_EQ(s.gain().best(), 0);
    EXPECT_EQ(s.gain().noisiest, VertexId::none);
}

// One pixel need not be divided, but its noise counts.
TEST(Gain, OnePixelIsNotRefined) {
    Square s(1);
    s.store({1, 9, 1, 9}, 5);
    EXPECT_EQ(s.gain().refine, 0);
    EXPECT_GT(s.gain().resample, 0);
}

// Error times fragments over cost: twice the fragments, twice the gain; twice the price, half.
TEST(Gain, IsInProportionToFragmentsOverCost) {
    Square one(100), two(200);
    for (Square* s : {&one, &two}) s->store({1, 9, 2, 4}, 0.1f);
    EXPECT_NEAR(two.gain().refine / one.gain().refine, 2, 1e-4f);
    EXPECT_NEAR(two.gain().resample / one.gain().resample, 2, 1e-4f);
    GainSettings dear = settings();
    dear.seconds_a_sample.fill(2e-6f);
    EXPECT_NEAR(one.gain().refine / gain(one.cache, one.root, 0, dear).refine, 2, 1e-4f);
    EXPECT_NEAR(one.gain().resample / gain(one.cache, one.root, 0, dear).resample, 2, 1e-4f);
}

// What is seen in a mirror that reflects a tenth errs by a tenth: a hundredth of the gain. The
// pixels' weights have three digits.
TEST(Gain, FallsWithTheSquareOfWhatIsSeen) {
    Square straight(100), in_mirror(0);
    IdMap map = random_map(in_mirror.cache, {in_mirror.root}, 100, in_mirror.rng);
    for (Fragment& f : map.fragments) f.reflectance = Rgb(0.1f * in_mirror.alone());
    attach(in_mirror.cache, map, 1);
    for (Square* s : {&straight, &in_mirror}) s->store({1, 9, 2, 4}, 0.1f);
    EXPECT_NEAR(straight.gain().refine / in_mirror.gain().refine, 100, 0.5f);
    EXPECT_NEAR(straight.gain().resample / in_mirror.gain().resample, 100, 0.5f);
}

// A channel of glossy radiance gains where its gloss shows, and nowhere else; one of irradiance
// where diffuse light does.
TEST(Gain, IsOfWhatAChannelLights) {
    const Scene scene = grid(1, 1);
    for (const bool gloss : {false, true}) {
        const MeshGraphs graphs(scene, CoarserLevels::none, 1);
        ShadingCache cache(scene, graphs, {.irradiance = 1, .glossy = 1}, SplitRule::always_four);
        const PatchId root = cache.root(ObjectId{0}, 0, true);
        Rng rng(1);
        IdMap map = random_map(cache, {root}, 100, rng);
        for (Fragment& f : map.fragments) {
            f.gloss = Rgb(gloss ? 1.0f : 0.0f);
            f.reflectance = Rgb(gloss ? 0.0f : 1.0f);
        }
        attach(cache, map, 1);
        for (int c = 0; c < 4; ++c)
            for (int channel = 0; channel < 2; ++channel)
                cache.store(cache.patch(root).corners[c], channel, Rgb(1.0f + float(c)), 0.1f, 64,
                            1);
        EXPECT_EQ(gain(cache, root, 0, settings()).best() > 0, !gloss);
        EXPECT_EQ(gain(cache, root, 1, settings()).best() > 0, gloss);
    }
}

// Where all is flat and known, the suspicion of 4.3 alone is left: epsilon^2 x fragments over the
// cost of 3 vertices.
TEST(Gain, SuspicionIsLeftWhereNothingIsSeen) {
    Square s(100);
    s.store({0, 0, 0, 0}, 0);
    const float expected = 0.001f * 0.001f * 100 / (3 * 64 * 1e-6f);
    EXPECT_NEAR(s.gain().refine, expected, 1e-3f * expected);
    EXPECT_EQ(s.gain().resample, 0);
}

// A child one of whose corners, a midpoint, missed its prediction by more gains more.
TEST(Gain, GrowsWithTheSurplus) {
    float previous = 0;
    for (const float miss : {0.0f, 0.5f, 1.0f, 2.0f, 4.0f}) {
        Square s(2000);
        s.store({8, 8, 8, 8}, 0);
        IdMap map = random_map(s.cache, {s.root}, 2000, s.rng);
        attach(s.cache, map, 1);
        const PatchId child = subdivide_seen(s.cache, map, s.root, 1);
        // Up at one midpoint and down at another: the mean light stays the same.
        const auto& corners = s.cache.patch(child).corners;
        s.cache.store(corners[1], 0, Rgb(8 + miss), 0, 64, 1);
        s.cache.store(corners[2], 0, Rgb(8), 0, 64, 1);
        s.cache.store(corners[3], 0, Rgb(8 - miss), 0, 64, 1);
        const float now = gain(s.cache, child, 0, settings()).refine;
        if (miss > 0.5f) {
            EXPECT_GT(now, previous);
        } else {
            EXPECT_GE(now, previous);  // a sixteenth of the parents' surplus is the least
        }
        previous = now;
    }
}

// The same difference of the corners: as noise it asks for samples, as signal for refinement; and
// samples go to the noisiest corner.
TEST(Gain, NoiseAsksForSamplesNotForRefinement) {
    Square noise(100), signal(100);
    noise.store({7, 9, 8, 8}, 4);  // a range of 2 = one standard error
    signal.store({7, 9, 8, 8}, 1e-6f);
    EXPECT_GT(signal.gain().refine, noise.gain().refine);
    EXPECT_GT(noise.gain().resample, 1000 * signal.gain().resample);
    EXPECT_GT(noise.gain().resample, noise.gain().refine);
    EXPECT_LT(signal.gain().resample, signal.gain().refine);

    noise.cache.store(noise.corners[2], 0, Rgb(8), 400, 64, 1);  // merged: 101
    EXPECT_EQ(noise.gain().noisiest, noise.corners[2]);
}

// No light found by 64 samples is not yet no light: where a channel says so, such a corner asks for
// samples as long as its neighbours are lit, the less the more it has had. Else zero is certain.
TEST(Gain, ZeroIsDoubtedWhereAChannelSaysSo) {
    GainSettings doubtful = settings();
    doubtful.zero_is_doubtful[0] = true;
    Square s(100);
    s.store({8, 8, 0, 8}, 0);
    EXPECT_EQ(gain(s.cache, s.root, 0, settings()).resample, 0);
    const Gain first = gain(s.cache, s.root, 0, doubtful);
    EXPECT_GT(first.resample, 0);
    EXPECT_EQ(first.noisiest, s.corners[2]);
    s.cache.store(s.corners[2], 0, Rgb(0), 0, 64, 1);
    EXPECT_NEAR(first.resample / gain(s.cache, s.root, 0, doubtful).resample, 4, 0.01f);

    Square night(100);
    night.store({0, 0, 0, 0}, 0);
    EXPECT_EQ(gain(night.cache, night.root, 0, doubtful).resample, 0);
}

// In a picture of irradiance a surface's colour counts for nothing.
TEST(Gain, APictureOfIrradianceDoesNotKnowColors) {
    std::array<float, 2> gains{}, of_radiance{};
    for (int i = 0; i < 2; ++i) {
        Square s(100);
        s.cache.patch(s.root).reflectance = i == 0 ? 0 : 255;
        s.store({7, 9, 8, 8}, 1e-6f);
        GainSettings irradiance = settings();
        irradiance.scale.irradiance = true;
        gains[i] = gain(s.cache, s.root, 0, irradiance).refine;
        of_radiance[i] = s.gain().refine;
    }
    EXPECT_EQ(gains[0], gains[1]);
    EXPECT_LT(of_radiance[0], of_radiance[1]);
}

// More samples at the noisiest corner lower its gain: variance falls as 1/n and the price of as
// many again rises as n, so four times the samples have a sixteenth of the gain.
TEST(Gain, ResamplingPaysLessWithTheSamples) {
    Square few(100), many(100);
    few.store({8, 8, 8, 8}, 4);
    for (int i = 0; i < 4; ++i) many.store({8, 8, 8, 8}, 4);
    EXPECT_NEAR(few.gain().resample / many.gain().resample, 16, 0.01f);
}

// A patch with some corners buried holds a contact line, and one with but a corner left is hardly
// known: both ask for refinement; buried corners ask for no samples.
TEST(Gain, BuriedCornersAskForRefinement) {
    float previous = 0;
    for (const int buried : {0, 1, 3}) {
        Square s(100);
        s.store({8, 8, 8, 8}, 1);
        for (int c = 0; c < buried; ++c) s.cache.mark_buried(s.corners[c]);
        EXPECT_GT(s.gain().refine, previous);
        previous = s.gain().refine;
    }
    Square s(100);
    s.store({8, 8, 8, 8}, 1);
    s.cache.store(s.corners[0], 0, Rgb(8), 9000, 64, 1);
    s.cache.mark_buried(s.corners[0]);
    EXPECT_NE(s.gain().noisiest, s.corners[0]);
    for (const VertexId v : s.corners) s.cache.mark_buried(v);
    EXPECT_EQ(s.gain().resample, 0);
}

// That coarser levels predicted a triangle's corners exactly tells of its inside while it covers up
// to 16 pixels. On a larger one they count as corners that nothing predicted: of 0.4 of all light.
TEST(Gain, CoarserLevelsTellNothingOfLargeTriangles) {
    float gain_a_pixel[2] = {};
    for (const bool large : {false, true}) {
        DenseGrid dense(24, 24);
        const PatchId root = dense.cache.root(ObjectId{0}, 555, true);
        Rng rng(1);
        IdMap map = random_map(dense.cache, {root}, large ? 17 : 16, rng);
        for (Fragment& f : map.fragments) f.reflectance = Rgb(1);
        attach(dense.cache, map, 1);
        for (const VertexId id : all_vertices(dense.cache)) {
            dense.cache.store(id, 0, Rgb(0.25f), 0, 64, 1);
            dense.cache.resolve();
        }
        gain_a_pixel[large] = gain(dense.cache, root, 0, settings()).refine / (large ? 17 : 16);
    }
    // Corners in the small one suspect a quarter of what their parents do for ever, or an eighth
    // and less: that of the coarsest, 0.4 of all light, a level or more above.
    EXPECT_GT(gain_a_pixel[0], 0);
    EXPECT_GT(gain_a_pixel[1], 10 * gain_a_pixel[0]);
}

// The front of a channel: ancestors refined, itself not.
TEST(Gain, TheFrontIsBelowWhatIsRefined) {
    Square s(100);
    const PatchId child = s.cache.subdivide(s.root);
    const PatchId grandchild = s.cache.subdivide(child);
    EXPECT_TRUE(on_front(s.cache, s.root, 0));
    EXPECT_FALSE(on_front(s.cache, child, 0));
    s.cache.patch(s.root).refined_channels = 1;
    EXPECT_FALSE(on_front(s.cache, s.root, 0));
    EXPECT_TRUE(on_front(s.cache, child, 0));
    EXPECT_FALSE(on_front(s.cache, grandchild, 0));
    s.cache.patch(child).refined_channels = 1;
    EXPECT_TRUE(on_front(s.cache, grandchild, 0));
}

// A new vertex starts with the samples of the poorest corner, between the channel's fewest and
// 4096.
TEST(Gain, NewVerticesStartAsTheirCornersStand) {
    for (const auto& [corner, expected] : {std::pair{8u, 32u}, std::pair{64u, 64u},
                                           std::pair{500u, 500u}, std::pair{9000u, 4096u}}) {
        Square s(100);
        for (const VertexId v : s.corners) s.cache.store(v, 0, Rgb(1), 0, 10'000, 1);
        EXPECT_EQ(samples_of_new(s.cache, s.root, 0, settings()), 4096u);
        Square poor(100);
        for (int c = 0; c < 4; ++c)
            poor.cache.store(poor.corners[c], 0, Rgb(1), 0, c == 2 ? corner : 10'000, 1);
        EXPECT_EQ(samples_of_new(poor.cache, poor.root, 0, settings()), expected);
    }
}

// A buried corner stays at the samples that told so, and does not speak of what its neighbours
// need.
TEST(Gain, NewVerticesDoNotStartAsBuriedCornersStand) {
    Square s(100);
    for (int c = 0; c < 4; ++c) s.cache.store(s.corners[c], 0, Rgb(1), 0, c == 2 ? 64 : 1024, 1);
    s.cache.mark_buried(s.corners[2]);
    EXPECT_EQ(samples_of_new(s.cache, s.root, 0, settings()), 1024u);
}

}  // namespace
}  // namespace chiaro
