// What is asked of the sample renderer: each vertex once a cycle, and its sequence continued where
// it was left.
#include "update/shade_work.h"

#include "sample_renderer/tiny_scenes.h"
#include "update/timings.h"

#include <gtest/gtest.h>

#include <thread>

namespace chiaro {
namespace {

// Answers with a constant and notes what it was asked.
class Clerk : public SampleRenderer {
public:
    std::vector<ShadeRequest> asked;
    Rgb answer = Rgb(3);
    SampleCosts typical_costs() const override { return {1e-7f, 1e-6f}; }
    void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) override {
        asked.insert(asked.end(), requests.begin(), requests.end());
        for (ShadeResult& r : results) r = {answer, 0.01f * answer, false};
    }
};

struct Desk {
    Scene scene;
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache;
    Clerk clerk;
    PatchId root;

    Desk() : scene(floor()), cache(scene, graphs, {2}, SplitRule::by_shape) {
        root = cache.root(ObjectId(0), 0, true);
    }
    static Scene floor() {
        Scene scene;
        tiny::add_quad(scene, Vec3(0), {1, 0, 0}, {0, 1, 0}, tiny::add_material(scene, Rgb(0.5f)));
        return scene;
    }
    static std::vector<ChannelPlan> plans() {
        return {{Light::direct, 32, 0}, {Light::indirect, 64, 0}};
    }
    VertexId corner(int i) const { return cache.patch(root).corners[i]; }
};

TEST(ShadeWork, AsksOnceForAVertexAndChannel) {
    Desk desk;
    ShadeWork work(Desk::plans(), 7);
    EXPECT_TRUE(work.evaluate(desk.cache, desk.corner(0), 0));
    EXPECT_FALSE(work.evaluate(desk.cache, desk.corner(0), 0)) << "asked for already";
    EXPECT_FALSE(work.resample(desk.cache, desk.corner(0), 0, 0)) << "asked for already";
    EXPECT_TRUE(work.evaluate(desk.cache, desk.corner(0), 1)) << "another channel";
    EXPECT_TRUE(work.evaluate(desk.cache, desk.corner(1), 0)) << "another vertex";
    EXPECT_EQ(work.points(), 3u);
    EXPECT_EQ(work.samples(0), 64u);
    EXPECT_EQ(work.samples(1), 64u);

    work.shade(desk.cache, desk.clerk, 0, 1);
    EXPECT_EQ(desk.clerk.asked.size(), 2u);
    EXPECT_NE(desk.clerk.asked[0].seed, desk.clerk.asked[1].seed);
    ShadeWork next(Desk::plans(), 7);
    EXPECT_FALSE(next.evaluate(desk.cache, desk.corner(0), 0)) << "evaluated";
    EXPECT_TRUE(next.evaluate(desk.cache, desk.corner(0), 1)) << "asked for, never shaded";
}

// Samples are numbered: each request begins where the ones before it ended, with the same seed, and
// doubles what there is, up to kMostAtOnce.
TEST(ShadeWork, ContinuesTheSequence) {
    Desk desk;
    std::uint32_t taken = 0;
    for (int round = 0; round < 12; ++round) {
        ShadeWork work(Desk::plans(), 7);
        EXPECT_TRUE(work.resample(desk.cache, desk.corner(2), 1, 0));
        work.shade(desk.cache, desk.clerk, 1, 1);
        const ShadeRequest& request = desk.clerk.asked.back();
        EXPECT_EQ(request.light, Light::indirect);
        EXPECT_EQ(request.first_sample, taken);
        EXPECT_EQ(request.samples, taken == 0 ? 64 : std::min(taken, ShadeWork::kMostAtOnce));
        EXPECT_EQ(request.seed, desk.clerk.asked.front().seed);
        taken += request.samples;
        EXPECT_EQ(desk.cache.estimate(desk.corner(2), 1)->samples, taken);
    }
}

// A vertex is its place: in another cache, with other ids, it draws the same numbers; under another
// session's seed it draws others.
TEST(ShadeWork, TheSeedIsThePlaces) {
    Desk one, two;
    two.cache.subdivide(two.cache.root(ObjectId(0), 0, false));
    const auto seed = [](Desk& desk, std::uint64_t session) {
        ShadeWork work(Desk::plans(), session);
        work.evaluate(desk.cache, desk.corner(3), 0);
        Clerk clerk;
        ShadingCache copy = desk.cache;
        work.shade(copy, clerk, 0, 1);
        return clerk.asked.at(0).seed;
    };
    EXPECT_EQ(seed(one, 7), seed(two, 7));
    EXPECT_NE(seed(one, 7), seed(one, 8));
    EXPECT_NE(seed(one, 7), seed(one, 7 + (std::uint64_t{1} << 32)));
}

// A vertex that 64 samples found no light at is not buried: it is evaluated in the other channels
// and sampled until 256 have found none, and then again if light is found after all.
TEST(ShadeWork, DarknessTakesSamplesToBelieve) {
    Desk desk;
    desk.clerk.answer = Rgb(0);
    auto plans = Desk::plans();
    plans[1].finds_buried = plans[1].zero_is_buried = true;
    plans[0].finds_buried = true;
    ShadeWork work(plans, 7);
    work.evaluate(desk.cache, desk.corner(0), 1);
    std::vector<std::uint32_t> samples;
    while (work.points() > 0) {
        for (const int c : {0, 1}) work.shade(desk.cache, desk.clerk, c, 1);
        samples.push_back(desk.cache.estimate(desk.corner(0), 1)->samples);
        EXPECT_EQ(desk.cache.vertex(desk.corner(0)).buried, samples.back() >= 256);
        work = work.doubts(desk.cache);
    }
    EXPECT_EQ(samples, (std::vector<std::uint32_t>{64, 128, 256}));
    EXPECT_TRUE(desk.cache.evaluated(desk.corner(0), 0));

    desk.clerk.answer = Rgb(3);
    ShadeWork more(plans, 7);
    more.resample(desk.cache, desk.corner(0), 1, 0);
    more.shade(desk.cache, desk.clerk, 1, 2);
    EXPECT_FALSE(desk.cache.vertex(desk.corner(0)).buried);
}

// Where no light was before an edit, there may be some now: as long as one channel is stale, a
// vertex that finds none in the other is not buried, and the stale one is sampled again at once.
TEST(ShadeWork, DarknessOfBeforeIsNotBelieved) {
    Desk desk;
    auto plans = Desk::plans();
    plans[1].finds_buried = plans[1].zero_is_buried = true;
    plans[0].finds_buried = true;
    const VertexId vertex = desk.corner(0);
    desk.cache.store(vertex, 0, Rgb(0), 0, 32, 1);
    desk.cache.outdate(vertex, 0, 1);
    desk.clerk.answer = Rgb(0);
    ShadeWork work(plans, 7);
    work.evaluate(desk.cache, vertex, 1, 256);
    work.shade(desk.cache, desk.clerk, 1, 2);
    EXPECT_FALSE(desk.cache.vertex(vertex).buried);

    ShadeWork doubts = work.doubts(desk.cache);
    ASSERT_EQ(doubts.points(), 1u);
    ShadeWork dark = doubts;
    ShadingCache copy = desk.cache;
    dark.shade(copy, desk.clerk, 0, 2);
    EXPECT_TRUE(copy.vertex(vertex).buried);
    desk.clerk.answer = Rgb(3);
    doubts.shade(desk.cache, desk.clerk, 0, 2);
    EXPECT_FALSE(desk.cache.vertex(vertex).buried);
    EXPECT_EQ(doubts.doubts(desk.cache).points(), 0u);
}

// Nested timers: the inner one's time is the inner step's alone, and the rows add up to what
// passed.
TEST(StepTimer, CountsNothingTwice) {
    using namespace std::chrono_literals;
    Timings timings;
    const auto start = std::chrono::steady_clock::now();
    {
        const StepTimer outer(timings, Step::sample_selection);
        std::this_thread::sleep_for(20ms);
        {
            const StepTimer inner(timings, Step::rendering);
            std::this_thread::sleep_for(30ms);
            const StepTimer innermost(timings, Step::aging);
            std::this_thread::sleep_for(10ms);
        }
        const StepTimer second(timings, Step::rendering);
        std::this_thread::sleep_for(10ms);
    }
    const double passed =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_GE(timings.of(Step::sample_selection), 0.020);
    EXPECT_GE(timings.of(Step::rendering), 0.040);
    EXPECT_GE(timings.of(Step::aging), 0.010);
    EXPECT_LE(timings.total(), passed);
    EXPECT_NEAR(timings.total(), passed, 0.001);
    EXPECT_EQ(timings.of(Step::tessellation), 0);
}

}  // namespace
}  // namespace chiaro
