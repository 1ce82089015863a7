// Vertices that nobody sees are sampled at places that are seen.
#include "sample_selector/relocate_hidden.h"

#include "sample_selector/gain_settings.h"
#include "shading_cache/dense_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace chiaro {
namespace {

using namespace tiny;

// Vertices are sampled so far from their corners at most.
constexpr float kPulledIn = 0.01f;

// A dense grid of 24 x 24, whose first rows something hides.
struct HalfSeen {
    DenseGrid dense;
    ShadingCache& cache = dense.cache;
    IdMap map;
    MeshFront front;
    Rng rng = Rng(7);

    HalfSeen() : dense(24, 24) {
        for (std::uint32_t i = 700; i < 1152; ++i) cache.root(ObjectId{0}, i, true);
        std::vector<PatchId> roots;
        for (std::size_t i = 0; i < cache.patches().size(); ++i)
            roots.push_back(static_cast<PatchId>(i));
        look_at(roots);
    }
    void look_at(const std::vector<PatchId>& roots) {
        map = random_map(cache, roots, 20'000, rng);
        attach(cache, map, 1);
        front.attach(cache);
    }
    std::vector<VertexId> hidden() const {
        auto vertices = all_vertices(cache);
        std::erase_if(vertices, [&](VertexId id) { return cache.of_root(id); });
        return vertices;
    }
};

std::vector<Vec3> positions(const ShadingCache& cache) {
    std::vector<Vec3> places;
    for (const VertexId id : all_vertices(cache)) places.push_back(position(cache, id));
    return places;
}

// All that is hidden moves to what is seen, and nothing that is seen or known moves.
TEST(RelocateHidden, HiddenVerticesAreSampledInView) {
    HalfSeen half;
    const auto before = positions(half.cache);
    float lowest_seen = INFINITY;
    for (const VertexId id : all_vertices(half.cache))
        if (half.cache.of_root(id)) lowest_seen = std::min(lowest_seen, before[index_of(id)].y);
    const auto hidden = half.hidden();
    ASSERT_GT(hidden.size(), 10u);
    const VertexId known = hidden[hidden.size() / 2];
    half.cache.store(known, 0, Rgb(1), 0, 64, 1);
    relocate_hidden(half.cache, half.front);
    const auto after = positions(half.cache);
    for (const VertexId id : all_vertices(half.cache)) {
        const bool moves = !half.cache.of_root(id) && id != known;
        EXPECT_EQ(half.cache.relocated(id), moves);
        if (!moves) {
            EXPECT_EQ(after[index_of(id)], before[index_of(id)]);
        } else {
            EXPECT_LT(before[index_of(id)].y, lowest_seen + kPulledIn);
            EXPECT_GE(after[index_of(id)].y, lowest_seen);
        }
    }
}

// The place is one that hangs on it much: nearer than most in view that hang on it directly.
TEST(RelocateHidden, ANearPlaceIsTaken) {
    HalfSeen half;
    const auto before = positions(half.cache);
    relocate_hidden(half.cache, half.front);
    const auto after = positions(half.cache);
    int tested = 0;
    for (const VertexId id : half.hidden()) {
        std::vector<float> distances;
        for (const VertexId child : all_vertices(half.cache)) {
            const auto parents = half.cache.parents(child);
            if (half.cache.of_root(child) &&
                std::find(parents.begin(), parents.end(), id) != parents.end())
                distances.push_back(glm::length(before[index_of(child)] - before[index_of(id)]));
        }
        if (distances.size() < 3) continue;
        ++tested;
        std::sort(distances.begin(), distances.end());
        EXPECT_LE(glm::length(after[index_of(id)] - before[index_of(id)]),
                  distances[distances.size() / 2]);
    }
    EXPECT_GE(tested, 4);
}

// What comes into view is sampled where it is, and weighs as if it had never been known elsewhere.
TEST(RelocateHidden, WhatComesIntoViewWeighsAsWhatIsNew) {
    HalfSeen half;
    relocate_hidden(half.cache, half.front);
    half.front.reckon(half.cache, settings(), 2);
    auto known = coarsest(half.cache);
    for (const VertexId id : known) half.cache.store(id, 0, Rgb(1), 0, 64, 1);
    half.front.settle(half.cache, known, 0, settings());
    // Rays that only pass by ask for other roots.
    const auto roots = front_roots(half.cache);
    const auto forgotten = half.cache.take_forgotten();
    EXPECT_GT(forgotten.size(), 3u);
    for (const auto& [id, channel] : forgotten) {
        EXPECT_FALSE(half.cache.evaluated(id));
        half.front.unsettle(half.cache, id, channel, settings());
    }
    MeshFront fresh;
    fresh.attach(half.cache);
    for (const VertexId id : all_vertices(half.cache)) {
        const auto place = [&](const MeshFront& front) {
            const auto all = front.vertices();
            return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), id) -
                                            all.begin());
        };
        if (place(half.front) == half.front.vertices().size()) continue;  // made since
        EXPECT_NEAR(half.front.pixels(half.cache, place(half.front), 0),
                    fresh.pixels(half.cache, place(fresh), 0), 0.01f);
    }
    for (const PatchId root : roots)
        for (int c = 0; c < 3; ++c)
            EXPECT_LT(glm::length(position(half.cache, half.cache.patch(root).corners[c]) -
                                  corner_position(half.cache, root, c)),
                      kPulledIn);
}

}  // namespace
}  // namespace chiaro
