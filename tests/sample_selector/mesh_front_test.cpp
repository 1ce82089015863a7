// The front of refinement on dense meshes: what weighs on which vertex, and who learns of what.
#include "sample_selector/mesh_front.h"

#include "sample_selector/gain_settings.h"
#include "shading_cache/dense_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chiaro {
namespace {

using namespace tiny;

// A dense grid of which a part is in view, and the front of all its vertices.
struct Front {
    DenseGrid dense;
    ShadingCache& cache = dense.cache;
    IdMap map;
    MeshFront front;

    explicit Front(std::uint32_t first_in_view = 0, int channels = 1) : dense(24, 24, channels) {
        auto roots = front_roots(cache);
        roots.erase(roots.begin(), roots.begin() + first_in_view);
        Rng rng(7);
        map = random_map(cache, roots, 20'000, rng);
        attach(cache, map, 1);
        front.attach(cache);
    }

    // Stores, as one cycle would: values first, then what they change on the front.
    // Returns what is news to others.
    std::vector<VertexId> store(std::vector<VertexId> vertices, int channel, const auto& value) {
        std::sort(vertices.begin(), vertices.end());
        for (const VertexId id : vertices) cache.store(id, channel, Rgb(value(id)), 0, 64, 1);
        const auto suspects = front.settle(cache, vertices, channel, settings());
        vertices.insert(vertices.end(), suspects.begin(), suspects.end());
        return vertices;
    }
    double pixels_in_view() const {
        double sum = 0;
        for (const Patch& p : cache.patches()) sum += p.pixels;
        return sum;
    }
    // What patches round them put on vertices.
    double own_pixels(const std::vector<VertexId>& vertices) const {
        double sum = 0;
        for (const Patch& p : cache.patches())
            for (int c = 0; c < 3; ++c)
                if (std::binary_search(vertices.begin(), vertices.end(), p.corners[c]))
                    sum += p.pixels / 3.0;
        return sum;
    }
    std::vector<VertexId> not_evaluated(int channel) const {
        auto left = all_vertices(cache);
        std::erase_if(left, [&](VertexId id) { return cache.evaluated(id, channel); });
        return left;
    }
    std::vector<VertexId> some_of(std::vector<VertexId> vertices, std::size_t count,
                                  Rng& rng) const {
        for (std::size_t i = 0; i < count; ++i)
            std::swap(vertices[i],
                      vertices[i + rng.below(static_cast<std::uint32_t>(vertices.size() - i))]);
        vertices.resize(count);
        return vertices;
    }
};

// Sums of thousands of floats of up to some hundred pixels.
constexpr float kRounding = 0.01f;

void expect_same_weights(const Front& f, const MeshFront& fresh, int channel) {
    ASSERT_TRUE(std::equal(fresh.vertices().begin(), fresh.vertices().end(),
                           f.front.vertices().begin(), f.front.vertices().end()));
    for (std::size_t place = 0; place < fresh.vertices().size(); ++place)
        ASSERT_NEAR(f.front.pixels(f.cache, place, channel), fresh.pixels(f.cache, place, channel),
                    kRounding)
            << place;
}

// All pixels weigh on the coarsest vertices as long as nothing is known.
TEST(MeshFront, PixelsInViewWeighOnTheCoarsestVertices) {
    Front f(600);
    double sum = 0;
    const auto known = coarsest(f.cache);
    for (std::size_t place = 0; place < f.front.vertices().size(); ++place)
        if (std::binary_search(known.begin(), known.end(), f.front.vertices()[place]))
            sum += f.front.pixels(f.cache, place, 0);
    EXPECT_GT(f.pixels_in_view(), 100);
    EXPECT_NEAR(sum / f.pixels_in_view(), 1, 1e-4);
}

// Once these are evaluated they speak for all but what is their own.
TEST(MeshFront, EvaluatedVerticesSpeakForAllPixelsThatAreNotTheirOwn) {
    Front f(600);
    const auto known = coarsest(f.cache);
    f.store(known, 0, [](VertexId) { return 8.0f; });
    double sum = 0;
    for (std::size_t place = 0; place < f.front.vertices().size(); ++place)
        if (f.cache.evaluated(f.front.vertices()[place], 0))
            sum += f.front.pixels(f.cache, place, 0);
    EXPECT_NEAR((sum + f.own_pixels(known)) / f.pixels_in_view(), 1, 1e-4);
}

// In any order, in batches of any size: what is lifted is what a new look would find gone.
TEST(MeshFront, SettlingLeavesWhatANewLookFinds) {
    Front f(300, 2);
    Rng rng(1);
    MeshFront fresh;
    while (true) {
        const int channel = static_cast<int>(rng.below(2));
        const auto left = f.not_evaluated(channel);
        if (left.size() < 60) break;
        f.store(f.some_of(left, 1 + rng.below(60), rng), channel,
                [&](VertexId) { return 8 * rng.uniform(); });
        fresh.attach(f.cache);
        for (int c = 0; c < 2; ++c) expect_same_weights(f, fresh, c);
    }
}

TEST(MeshFront, NothingWeighsWhereAllIsEvaluated) {
    Front f;
    f.store(all_vertices(f.cache), 0, [](VertexId id) { return float(index_of(id) % 9); });
    f.front.reckon(f.cache, settings(), 2);
    for (std::size_t place = 0; place < f.front.vertices().size(); ++place)
        EXPECT_NEAR(f.front.pixels(f.cache, place, 0), 0, kRounding);
    EXPECT_NEAR(f.front.total(0), 0, 1e-3);
}

// Numbers of vertices that stand for a level do not grow with it; level 0 is all that is in view:
// of a grid in full view its 25 x 25 corners.
TEST(MeshFront, LevelsHaveFewerVerticesTheCoarserTheyAre) {
    const Front all, part(600);
    for (const Front* f : {&all, &part}) {
        const auto counts = f->front.count_by_level(Shading::irradiance);
        for (int l = 1; l < MeshFront::kLevels; ++l) EXPECT_LE(counts[l], counts[l - 1]) << l;
        std::size_t in_view = 0;
        for (std::size_t place = 0; place < f->front.vertices().size(); ++place)
            in_view += f->front.in_view(place, Shading::irradiance) ? 1 : 0;
        EXPECT_EQ(counts[0], in_view);
        EXPECT_GT(counts[LevelSettings{}.levels], 20u);
        EXPECT_EQ(f->front.count_by_level(Shading::glossy)[0], 0u);  // nothing is glossy here
    }
    EXPECT_EQ(all.front.count_by_level(Shading::irradiance)[0], 25u * 25);
    EXPECT_LT(part.front.count_by_level(Shading::irradiance)[0], 25u * 25);
}

// Carrying shows what one pass over all would, and looks at those alone whose parents changed.
TEST(MeshFront, CarryingShowsWhatAFullPassWould) {
    Front f;
    f.front.reckon(f.cache, settings(), 2);
    Rng rng(3);
    std::vector<VertexId> news = coarsest(f.cache);
    for (int batch = 0; batch < 12; ++batch) {
        f.store(news, 0, [&](VertexId) { return 20 + 80 * rng.uniform(); });
        if (batch == 5) f.cache.mark_buried(news[3]);
        ShadingCache full = f.cache;
        full.resolve();
        const std::size_t carried = f.front.carry(f.cache, news, 0, settings(), 2);
        expect_same_shown(f.cache, full);
        EXPECT_LE(carried, f.not_evaluated(0).size() + 1);
        if (batch == 0) {
            EXPECT_EQ(carried, f.not_evaluated(0).size());  // all hang on them
        }
        EXPECT_EQ(f.front.carry(f.cache, {}, 0, settings(), 2), 0u);
        // A second look changes nothing: it ends at the children.
        EXPECT_LE(f.front.carry(f.cache, news, 0, settings(), 2), carried);
        expect_same_shown(f.cache, full);
        news = f.some_of(f.not_evaluated(0), 40, rng);
    }
}

TEST(MeshFront, NothingIsCarriedWhereAllIsEvaluated) {
    Front f;
    f.front.reckon(f.cache, settings(), 2);
    f.store(all_vertices(f.cache), 0, [](VertexId) { return 8.0f; });
    for (const VertexId id : coarsest(f.cache)) f.cache.store(id, 0, Rgb(9), 0, 64, 1);
    EXPECT_EQ(f.front.carry(f.cache, coarsest(f.cache), 0, settings(), 2), 0u);
}

// A vertex and another that has a parent in common with it, both not evaluated and in view.
struct Siblings {
    VertexId one, other, parent;
};
Siblings siblings(const ShadingCache& cache) {
    const auto all = all_vertices(cache);
    for (const VertexId one : all)
        for (const VertexId other : all) {
            if (one >= other || cache.evaluated(one, 0) || cache.evaluated(other, 0)) continue;
            const auto theirs = cache.parents(other);
            for (const VertexId parent : cache.parents(one))
                if (cache.evaluated(parent, 0) &&
                    std::find(theirs.begin(), theirs.end(), parent) != theirs.end())
                    return {one, other, parent};
        }
    return {VertexId::none, VertexId::none, VertexId::none};
}

// A miss raises the suspicion of what had spoken: its other children gain more by being looked at,
// and the draw knows it.
TEST(MeshFront, AMissIsSuspectedOfItsSiblings) {
    Front f;
    f.store(coarsest(f.cache), 0, [](VertexId) { return 0.5f; });
    f.front.reckon(f.cache, settings(), 2);
    f.front.carry(f.cache, coarsest(f.cache), 0, settings(), 2);
    const auto [one, other, parent] = siblings(f.cache);
    const auto gain = [&](VertexId id) {
        return gain_of_first(f.cache, id, 0, {.pixels = 1}, settings());
    };
    const float surplus = f.cache.surplus(parent, 0), before = gain(other);
    f.store({one}, 0, [](VertexId) { return 4.0f; });
    EXPECT_NEAR(f.cache.surplus(one, 0), 3.5f, 0.02f);  // what it missed
    EXPECT_LT(surplus, 1);
    EXPECT_NEAR(f.cache.surplus(parent, 0), 3.5f, 0.02f);
    EXPECT_GT(gain(other), 2 * before);
    // One that agrees raises nothing.
    const float raised = gain(other);
    f.cache.resolve();
    f.store({siblings(f.cache).one}, 0,
            [&](VertexId id) { return luminance(f.cache.shown(id, 0).value); });
    EXPECT_EQ(gain(other), raised);
}

// What the draw goes by after a cycle is nearly what a reckoning of everything would give it: it
// does not know yet what was lifted off vertices that still wait for their own parents.
TEST(MeshFront, TheDrawLearnsOfAllThatACycleChanged) {
    Front f;
    f.front.reckon(f.cache, settings(), 2);
    Rng rng(5);
    std::vector<VertexId> news = coarsest(f.cache);
    for (int batch = 0; batch < 8; ++batch) {
        news = f.store(news, 0, [&](VertexId) { return 0.2f + 4 * rng.uniform(); });
        f.front.carry(f.cache, news, 0, settings(), 2);
        const double known = f.front.total(0);
        f.front.reckon(f.cache, settings(), 2);
        EXPECT_NEAR(known / f.front.total(0), 1, 0.05) << batch;
        news = f.some_of(f.not_evaluated(0), 20, rng);
    }
}

// A fine vertex that speaks for nobody is sampled again by what its own pixels gain, as long as the
// patches round it wait for other corners; from then on that is theirs to ask for.
TEST(MeshFront, NoiseAmongUnknownVerticesIsSampledAgain) {
    for (const float variance : {0.0f, 25.0f}) {
        Front f;
        f.store(coarsest(f.cache), 0, [](VertexId) { return 1.0f; });
        const auto left = f.not_evaluated(0);
        const VertexId fine =
            *std::ranges::find_if(left, [&](VertexId id) { return f.cache.level(id) == 0; });
        f.cache.store(fine, 0, Rgb(1), variance, 64, 1);
        f.front.settle(f.cache, std::vector{fine}, 0, settings());
        f.front.reckon(f.cache, settings(), 2);
        const double total = f.front.total(0);
        f.front.rest(fine, 0);
        const double own_gain = total - f.front.total(0);
        EXPECT_EQ(own_gain > 1e-6 * total, variance > 0);
        f.store(f.not_evaluated(0), 0, [](VertexId) { return 1.0f; });
        f.front.reckon(f.cache, settings(), 2);
        EXPECT_LT(f.front.total(0), 1e-3 * total);
    }
}

// Coarse ones first: a vertex waits until half of what predicts it is evaluated, unless nothing is
// known of it at all.
TEST(MeshFront, VerticesWaitForHalfOfTheirParents) {
    Front f;
    for (const VertexId id : all_vertices(f.cache)) {
        const Parents parents = f.cache.parents(id);
        if (parents.size() < 3) continue;
        ShadingCache cache = f.cache;
        float known = 0;
        EXPECT_GT(gain_of_first(cache, id, 0, {.pixels = 10}, settings()), 0);
        for (std::size_t i = 0; i < parents.size(); ++i) {
            cache.store(parents[i], 0, Rgb(1), 0, 64, 1);
            cache.resolve();
            known += parents.weight(i);
            EXPECT_EQ(gain_of_first(cache, id, 0, {.pixels = 10}, settings()) > 0, known >= 0.5f)
                << i;
        }
        if (index_of(id) > 400) break;
    }
}

// Levels that agree all round tell little of the corners of a triangle of more than 16 pixels:
// these gain more than twice as much a pixel as those of a small one.
TEST(MeshFront, CornersOfLargeTrianglesDoNotTrustTheLevels) {
    float gain_a_pixel[2] = {};
    for (const bool large : {false, true}) {
        DenseGrid dense(24, 24);
        const PatchId root = dense.cache.root(ObjectId{0}, 555, true);
        Rng rng(1);
        IdMap map = random_map(dense.cache, {root}, large ? 17 : 16, rng);
        for (Fragment& f : map.fragments) f.reflectance = Rgb(1);
        attach(dense.cache, map, 1);
        const auto corners = std::span(dense.cache.patch(root).corners).first(3);
        const VertexId corner = *std::ranges::find_if(
            corners, [&](VertexId v) { return !dense.cache.parents(v).empty(); });
        for (const VertexId id : all_vertices(dense.cache))
            if (id != corner) dense.cache.store(id, 0, Rgb(0.25f), 0, 64, 1);
        dense.cache.resolve();
        MeshFront front;
        front.attach(dense.cache);
        front.reckon(dense.cache, settings(), 1);
        gain_a_pixel[large] = static_cast<float>(front.total(0)) / (large ? 17 : 16);
    }
    EXPECT_GT(gain_a_pixel[0], 0);
    EXPECT_GT(gain_a_pixel[1], 2 * gain_a_pixel[0]);
}

// What is drawn is in view, not known yet, and not of what rests.
TEST(MeshFront, WhatIsDrawnIsInView) {
    Front f(900);
    f.store(coarsest(f.cache), 0, [](VertexId) { return 1.0f; });
    f.front.reckon(f.cache, settings(), 2);
    Rng rng(1);
    for (int i = 0; i < 300 && f.front.total(0) > 0; ++i) {
        const VertexId drawn = f.front.draw(0, rng.uniform());
        EXPECT_FALSE(f.cache.evaluated(drawn, 0));  // without noise there is no more to gain
        const auto vertices = f.front.vertices();
        const auto place = std::find(vertices.begin(), vertices.end(), drawn) - vertices.begin();
        EXPECT_TRUE(f.front.in_view(static_cast<std::size_t>(place), Shading::irradiance));
        f.front.rest(drawn, 0);
        for (int k = 0; k < 20 && f.front.total(0) > 0; ++k)
            EXPECT_NE(f.front.draw(0, rng.uniform()), drawn);
    }
}

// The roots in view round a vertex are those that have it as a corner.
TEST(MeshFront, RootsRoundAVertexAreThoseThatShareIt) {
    const Front f(300);
    for (const VertexId id : all_vertices(f.cache)) {
        std::vector<PatchId> expected;
        for (std::uint32_t i = 0; i < f.cache.patches().size(); ++i) {
            const auto& corners = f.cache.patches()[i].corners;
            if (f.cache.patches()[i].fragment_count > 0 &&
                std::find(corners.begin(), corners.end(), id) != corners.end())
                expected.push_back(static_cast<PatchId>(i));
        }
        const auto found = f.front.roots_round(id);
        EXPECT_EQ(std::vector<PatchId>(found.begin(), found.end()), expected);
    }
}

}  // namespace
}  // namespace chiaro
