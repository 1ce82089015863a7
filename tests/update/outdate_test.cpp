// What an edit makes stale, and what it makes forgotten.
#include "update/outdate.h"

#include "shading_cache/cache_testing.h"

namespace chiaro {
namespace {

using namespace tiny;

const std::vector<ChannelPlan> kPlans = {{.light = Light::direct}, {.light = Light::glossy}};

// Three unit squares in a row, facing up, each corner lit; a lamp 2 m above the first; and another
// object far off.
struct Row {
    Scene scene = with_lamp(grid(3, 1));
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache{scene, graphs, {1, 1}, SplitRule::always_four};
    ExpectedChange expected;
    LeastLight least = {0.01f, 0.01f};

    Row() {
        front_roots(cache);
        for (std::size_t i = 0; i < cache.vertices().size(); ++i)
            for (const int channel : {0, 1})
                cache.store(static_cast<VertexId>(i), channel, Rgb(8), 0.25f, 64, 1);
    }
    Row(const Row&) = delete;
    Row& operator=(const Row&) = delete;

    static Scene with_lamp(Scene scene) {
        scene.lights.push_back(point_light({0, 0, 2}, Rgb(10)));
        add_quad(scene, {50, 0, 0}, {1, 0, 0}, {0, 1, 0}, add_material(scene, Rgb(0.5f)));
        return scene;
    }
    // The corner there; corners are sampled a little beside their places.
    VertexId at(float x, float y) const {
        const auto distance = [&](std::uint32_t i) {
            const SurfacePoint at = cache.surface_point(VertexId{i});
            return glm::length(surface_position(scene, at) - Vec3(x, y, 0));
        };
        std::uint32_t nearest = 0;
        for (std::uint32_t i = 1; i < cache.vertices().size(); ++i)
            if (distance(i) < distance(nearest)) nearest = i;
        return VertexId{nearest};
    }
    bool stale(VertexId id, int channel) const { return cache.estimate(id, channel)->stale; }
    void outdate(const SceneChange& change) {
        chiaro::outdate(cache, scene, kPlans, change, least, expected, 1);
    }
    // Something of 20 cm has come to a place between the lamp and the last square.
    static SceneChange something_came() {
        SceneChange change;
        change.geometry = true;
        change.moved = {ObjectId{1}};
        change.boxes = {Box{{1.4f, -0.1f, 0.9f}, {1.6f, 0.1f, 1.1f}}};
        return change;
    }
};

// Direct light is stale behind what came and nowhere else, all other light everywhere.
TEST(Outdate, DirectLightIsStaleInTheShadowAlone) {
    Row row;
    row.outdate(Row::something_came());
    EXPECT_TRUE(row.stale(row.at(3, 0), 0));
    EXPECT_FALSE(row.stale(row.at(1, 0), 0));
    EXPECT_TRUE(row.stale(row.at(1, 0), 1));
}

// A vertex that something buries which stands, and that found some light all the same, is judged
// anew where a shadow falls on it or goes; one that nothing has come near stays buried.
TEST(Outdate, WhatIsBuriedIsJudgedAnewInTheShadow) {
    Row row;
    row.cache.mark_buried(row.at(3, 0));
    row.cache.mark_buried(row.at(1, 0));
    row.outdate(Row::something_came());
    EXPECT_FALSE(row.cache.evaluated(row.at(3, 0)));
    EXPECT_FALSE(row.cache.vertex(row.at(3, 0)).buried);
    EXPECT_TRUE(row.cache.evaluated(row.at(1, 0)));
    EXPECT_TRUE(row.cache.vertex(row.at(1, 0)).buried);
}

// A surface whose own material is another may show something else altogether; what lies beside it,
// little of it. Direct light knows of no material.
TEST(Outdate, GlossIsItsOwnMaterials) {
    Row row;
    SceneChange change;
    change.materials = true;
    change.repainted = {MaterialId{0}};
    row.outdate(change);
    EXPECT_GE(row.expected.relative2(ObjectId{0}, 1), 1);
    EXPECT_LT(row.expected.relative2(ObjectId{1}, 1), 0.1f);
    EXPECT_FALSE(row.stale(row.at(1, 0), 0));
    EXPECT_TRUE(row.stale(row.at(1, 0), 1));
}

// A walk of small steps shows as much else of what nobody has shaded meanwhile as one long step:
// after 40 of 3 cm each, as after one of 1.2 m, what was shaded before tells nothing and is
// forgotten.
TEST(Outdate, StepsOfAWalkAddUp) {
    Row row;
    row.scene.materials[0].gloss = metal(0.25f);
    EyeTrack track;
    track.move_to({1, 0, 1}, 1);
    for (Cycle now = 2; now < 42; ++now) {
        const Vec3 eye(1 + 0.03f * static_cast<float>(now - 1), 0, 1);
        outdate_gloss(row.cache, row.scene, {track, now, eye}, row.least, row.expected, 1);
        track.move_to(eye, now);
    }
    for (std::size_t i = 0; i < row.cache.vertices().size(); ++i)
        EXPECT_FALSE(row.cache.evaluated(static_cast<VertexId>(i), 1));
}

// The eye is found where it was in each cycle, also where estimates know the lower bits of the
// cycle alone and the track forgets what none remembers.
TEST(EyeTrack, IsAsLongAsEstimatesRemember) {
    EyeTrack track;
    for (Cycle cycle = 0; cycle < 20'000; cycle += 10)
        track.move_to(Vec3(static_cast<float>(cycle)), cycle);
    for (const Cycle cycle : {19'999u, 19'990u, 15'005u, 11'900u}) {
        Estimate estimate;
        estimate.shaded_at = cycle & Estimate::kCycleMask;
        EXPECT_EQ(track.at(estimate, 20'000).x, static_cast<float>(cycle / 10 * 10));
    }
}

// What lets other light through may be anywhere: all that is buried is judged anew.
TEST(Outdate, WhatIsBuriedIsJudgedAnewWhereOtherLightComesThrough) {
    Row row;
    row.cache.mark_buried(row.at(1, 0));
    SceneChange change;
    change.materials = change.passing = true;
    row.outdate(change);
    EXPECT_FALSE(row.cache.evaluated(row.at(1, 0)));
    EXPECT_TRUE(row.stale(row.at(2, 0), 0));
}

}  // namespace
}  // namespace chiaro
