// Fragments stand on the leaf that holds them, whatever is divided.
#include "shading_cache/id_map.h"

#include "shading_cache/cache_testing.h"

#include <algorithm>

namespace chiaro {
namespace {

using namespace tiny;

struct Place {
    std::uint32_t surface_side;
    Vec2 uv;
};

// All that is promised of an attached map, `before` being where its fragments were on the roots.
void expect_attached(const ShadingCache& cache, const IdMap& map,
                     const std::vector<Place>& before) {
    std::vector<int> seen(map.fragments.size(), 0);
    for (std::uint32_t i = 0; i < cache.patches().size(); ++i) {
        const auto id = static_cast<PatchId>(i);
        const Patch& patch = cache.patch(id);
        if (patch.is_leaf()) {
            for (const std::uint32_t f : fragments_of(map, patch)) {
                ++seen[f];
                EXPECT_EQ(map.fragments[f].patch, id);
            }
            continue;
        }
        // The range of an inner patch is that of its children, one after the other.
        std::uint32_t next = patch.first_fragment;
        for (int c = 0; c < child_count(patch.split) && patch.fragment_count > 0; ++c) {
            const Patch& child = cache.patch(offset_by(patch.first_child, c));
            if (child.fragment_count > 0) {
                EXPECT_EQ(child.first_fragment, next);
            }
            next += child.fragment_count;
        }
        EXPECT_EQ(next, patch.first_fragment + patch.fragment_count);
    }
    for (std::size_t f = 0; f < seen.size(); ++f) {
        EXPECT_EQ(seen[f], 1);
        const Fragment& fragment = map.fragments[f];
        EXPECT_EQ(cache.surface_side(fragment.patch), before[f].surface_side);
        EXPECT_NEAR(glm::length(cache.surface_uv(fragment.patch, fragment.local) - before[f].uv), 0,
                    1e-4f);
    }
}

std::vector<Place> places_of(const ShadingCache& cache, const IdMap& map) {
    std::vector<Place> places;
    for (const Fragment& f : map.fragments)
        places.push_back({cache.surface_side(f.patch), f.local});
    return places;
}

Rgb total_reflectance(const IdMap& map) {
    Rgb sum(0);
    for (const Fragment& f : map.fragments) sum += f.reflectance;
    return sum;
}

// Attached to a divided cache, and divided further: each fragment is on one leaf, at its old place,
// and of its old weight.
TEST(IdMap, FragmentsStayInPlaceWhateverIsDivided) {
    for (const bool triangles : {false, true})
        for (const SplitRule rule : {SplitRule::always_four, SplitRule::by_shape}) {
            Rng rng(1);
            const Scene scene = grid(3, 2, triangles, stretched(4));
            const MeshGraphs graphs(scene, CoarserLevels::none, 1);
            ShadingCache cache(scene, graphs, {1}, rule);
            const auto roots = front_roots(cache);
            subdivide_at_random(cache, 100, rng);
            IdMap map = random_map(cache, roots, 3000, rng);
            const auto before = places_of(cache, map);
            const Rgb reflectance = total_reflectance(map);
            attach(cache, map, 5);
            expect_attached(cache, map, before);
            for (int i = 0; i < 200; ++i) {
                const auto open = leaves(cache);
                const auto pick = rng.below(static_cast<std::uint32_t>(open.size()));
                subdivide_seen(cache, map, open[pick], 6);
            }
            expect_attached(cache, map, before);
            EXPECT_EQ(total_reflectance(map), reflectance);
        }
}

// 3.1: "patches that are visible in the current view are marked as seen"; no others.
TEST(IdMap, OnlyWhatIsInViewIsMarkedAsSeen) {
    Rng rng(2);
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto roots = front_roots(cache);
    subdivide_at_random(cache, 30, rng);
    IdMap map = random_map(cache, {roots[0]}, 50, rng);
    attach(cache, map, 9);
    for (std::uint32_t i = 0; i < cache.patches().size(); ++i) {
        const Patch& patch = cache.patches()[i];
        EXPECT_EQ(patch.last_seen, patch.fragment_count > 0 ? 9u : 0u);
        if (cache.surface_side(static_cast<PatchId>(i)) != 0) {
            EXPECT_EQ(patch.fragment_count, 0u);
        }
    }
    EXPECT_EQ(cache.patch(roots[0]).fragment_count, 50u);
}

// A second map replaces the first.
TEST(IdMap, AnotherViewStartsAnew) {
    Rng rng(3);
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto roots = front_roots(cache);
    IdMap first = random_map(cache, roots, 500, rng);
    attach(cache, first, 1);
    for (int i = 0; i < 20; ++i) subdivide_seen(cache, first, leaves(cache).front(), 1);
    IdMap second = random_map(cache, {roots[1]}, 100, rng);
    const auto before = places_of(cache, second);
    attach(cache, second, 2);
    expect_attached(cache, second, before);
    EXPECT_EQ(cache.patch(roots[0]).fragment_count, 0u);
    EXPECT_EQ(cache.patch(roots[1]).fragment_count, 100u);
}

// A pixel's fragments are found by the pixel.
TEST(IdMap, FragmentsAreFoundByPixel) {
    Rng rng(4);
    const Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const IdMap map = random_map(cache, front_roots(cache), 10, rng);
    for (std::uint32_t p = 0; p < 10; ++p) {
        ASSERT_EQ(map.at_pixel(p).size(), 1u);
        EXPECT_EQ(map.at_pixel(p)[0].pixel, p);
    }
}

// A patch weighs the squares of its shares of pixels: alone in one 1, in two quarters of one 1/4,
// in two halves that each shine half as much 1/4 too. Gloss weighs by itself.
TEST(IdMap, PatchesWeighTheSquaresOfTheirShares) {
    const Scene scene = grid(1, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const PatchId root = front_roots(cache)[0];
    const float alone = cache.patch(root).reflectance / 255.0f / kPi;
    IdMap map;
    map.width = 3;
    map.height = 1;
    map.background = Image(3, 1);
    map.first_of_pixel = {0, 1, 3, 5};
    const Vec2 at(0.1f, 0.2f);
    map.fragments = {{0, root, at, Rgb(alone), Rgb(1)},
                     {1, root, at, Rgb(alone / 4)},
                     {1, root, at, Rgb(alone / 4)},
                     {2, root, at, Rgb(alone / 4), Rgb(0.5f)},
                     {2, root, at, Rgb(alone / 4)}};
    attach(cache, map, 1);
    EXPECT_NEAR(cache.patch(root).pixels, 1.5f, 0.01f);
    EXPECT_NEAR(cache.patch(root).glossy_pixels, 1.25f, 0.01f);
    const PatchId child = subdivide_seen(cache, map, root, 1);
    EXPECT_NEAR(cache.patch(child).pixels, 1.5f, 0.01f);
    EXPECT_EQ(cache.patch(offset_by(child, 2)).pixels, 0);
}

}  // namespace
}  // namespace chiaro
