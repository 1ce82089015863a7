// Vertices that nobody sees are sampled at places that are seen.
#include "sample_selector/stand_ins.h"

#include "shading_cache/dense_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace chiaro {
namespace {

using namespace tiny;

// Vertices are sampled so far from their corners at most.
constexpr float kPulledIn = 0.01f;

// A dense grid, whose first rows something hides.
struct HalfSeen {
    DenseGrid dense = DenseGrid(24, 24);
    ShadingCache& cache = dense.cache;
    IdMap map;
    MeshFront front;

    HalfSeen() {
        for (std::uint32_t i = 700; i < 1152; ++i) cache.root(ObjectId{0}, i, true);
        std::vector<PatchId> roots;
        for (std::size_t i = 0; i < cache.patches().size(); ++i)
            roots.push_back(static_cast<PatchId>(i));
        Rng rng(7);
        map = random_map(cache, roots, 20'000, rng);
        attach(cache, map, 1);
        front.attach(cache);
    }
    bool seen(VertexId id) const {
        const auto vertices = front.vertices();
        return front.seen(static_cast<std::size_t>(
            std::lower_bound(vertices.begin(), vertices.end(), id) - vertices.begin()));
    }
};

// All that is hidden moves to what is seen, and nothing that is seen or known moves.
TEST(StandIns, HiddenVerticesAreSampledInView) {
    HalfSeen half;
    std::map<VertexId, Vec3> before;
    float lowest_seen = INFINITY;
    std::size_t hidden = 0;
    for (const VertexId id : all_vertices(half.cache)) {
        before[id] = position(half.cache, id);
        if (half.seen(id)) lowest_seen = std::min(lowest_seen, position(half.cache, id).y);
        if (!half.seen(id)) ++hidden;
    }
    ASSERT_GT(hidden, 10u);
    VertexId known = VertexId::none;
    for (const VertexId id : all_vertices(half.cache))
        if (!half.seen(id)) known = id;
    half.cache.store(known, 0, Rgb(1), 0, 64, 1);
    sample_hidden_in_view(half.cache, half.front);
    for (const VertexId id : all_vertices(half.cache)) {
        if (half.seen(id) || id == known) {
            EXPECT_EQ(position(half.cache, id), before[id]);
        } else {
            EXPECT_LT(before[id].y, lowest_seen + kPulledIn);
            EXPECT_GE(position(half.cache, id).y, lowest_seen);
        }
    }
}

// The place is that of what it speaks for most: nearer than half of all that it speaks for.
TEST(StandIns, TheNearestStandsIn) {
    HalfSeen half;
    const auto all = all_vertices(half.cache);
    for (const VertexId id : all) {
        if (half.seen(id)) continue;
        const Vec3 place = position(half.cache, id);
        std::vector<float> distances;
        for (const VertexId child : all) {
            const auto parents = half.cache.vertex(child).known_parents();
            if (half.seen(child) && std::find(parents.begin(), parents.end(), id) != parents.end())
                distances.push_back(glm::length(position(half.cache, child) - place));
        }
        if (distances.size() < 3) continue;
        std::sort(distances.begin(), distances.end());
        ShadingCache moved = half.cache;
        sample_hidden_in_view(moved, half.front);
        const Vec3 now = position(moved, id);
        EXPECT_LE(glm::length(now - place), distances[distances.size() / 2]);
    }
}

}  // namespace
}  // namespace chiaro
