// Vertices of dense meshes in the cache: which are made, and what they show before they are
// evaluated.
#include "shading_cache/dense_grid.h"

#include <algorithm>

namespace chiaro {
namespace {

using namespace tiny;

// The mesh's vertex that one of the cache's is, by the corner it was sampled at.
std::uint32_t in_mesh(const DenseGrid& dense, VertexId id) {
    const SurfacePoint at = dense.cache.surface_point(id);
    const std::array<float, 3> distances = {at.u + at.v, 1 - at.u + at.v, at.u + 1 - at.v};
    const auto nearest = std::min_element(distances.begin(), distances.end()) - distances.begin();
    const MeshCorner corner = {at.primitive, static_cast<int>(nearest)};
    return dense.graph().vertex_of_corner[corner_index(dense.mesh(), corner)];
}

// A vertex of a mesh and all that it is predicted from, by any number of steps.
void collect(const MeshGraph& graph, std::uint32_t vertex, std::set<std::uint32_t>& all) {
    if (!all.insert(vertex).second) return;
    for (const std::uint32_t parent : graph.parents_of(MeshVertexId{vertex}))
        collect(graph, parent, all);
}

// The parents of all vertices of the cache are those of the mesh, with their weights.
void expect_the_meshs_parents(const DenseGrid& dense) {
    for (const VertexId id : all_vertices(dense.cache)) {
        EXPECT_TRUE(dense.cache.vertex(id).of_mesh);
        const Parents known = dense.cache.parents(id);
        const MeshVertexId vertex{in_mesh(dense, id)};
        const auto parents = dense.graph().parents_of(vertex);
        const auto weights = dense.graph().weights_of(vertex);
        ASSERT_EQ(known.size(), parents.size());
        for (std::size_t i = 0; i < parents.size(); ++i) {
            EXPECT_EQ(in_mesh(dense, known[i]), parents[i]);
            EXPECT_EQ(known.whole_weight(i), weights[i]);
            EXPECT_EQ(dense.cache.on_front(known[i]), dense.cache.on_front(id));
        }
    }
}

TEST(MeshVertices, ARootMakesItsCornersAndAllThatPredictThem) {
    DenseGrid dense(32, 32);
    std::set<std::uint32_t> expected;
    for (const std::uint32_t primitive : {0u, 1u, 777u, 2047u}) {
        dense.cache.root(ObjectId{0}, primitive, true);
        for (int c = 0; c < 3; ++c)
            collect(dense.graph(),
                    dense.graph().vertex_of_corner[corner_index(dense.mesh(), {primitive, c})],
                    expected);
        std::set<std::uint32_t> made;
        for (const VertexId id : all_vertices(dense.cache)) made.insert(in_mesh(dense, id));
        EXPECT_EQ(made, expected);
        EXPECT_EQ(dense.cache.vertices().size(), made.size());  // each once
        expect_consistent(dense.cache);
    }
    expect_the_meshs_parents(dense);
    // Unseen parts of the mesh cost no vertices: three triangles' worth of 1089.
    EXPECT_LT(dense.cache.vertices().size(), 150u);
}

// Of a level that is all in view nothing is made twice, whatever comes first.
TEST(MeshVertices, AMeshInViewHasTheMeshsVertices) {
    DenseGrid dense(16, 16);
    for (std::uint32_t i = 0; i < 512; ++i) dense.cache.root(ObjectId{0}, (i * 211) % 512, true);
    EXPECT_EQ(dense.cache.vertices().size(), 17u * 17);
    EXPECT_EQ(dense.cache.patches().size(), 512u);
    expect_consistent(dense.cache);
    expect_the_meshs_parents(dense);
    for (const VertexId id : all_vertices(dense.cache))
        EXPECT_EQ(dense.cache.level(id), dense.graph().level[in_mesh(dense, id)]);
}

TEST(MeshVertices, BackSidesHaveVerticesOfTheirOwnWithTheSameParents) {
    DenseGrid dense(16, 16);
    front_roots(dense.cache);
    for (std::uint32_t i = 0; i < 512; ++i) dense.cache.root(ObjectId{0}, i, false);
    EXPECT_EQ(dense.cache.vertices().size(), 2u * 17 * 17);
    std::size_t fronts = 0;
    for (const VertexId id : all_vertices(dense.cache)) fronts += dense.cache.on_front(id) ? 1 : 0;
    EXPECT_EQ(fronts, 17u * 17);
    expect_consistent(dense.cache);
    expect_the_meshs_parents(dense);
}

// A vertex that nobody sees is sampled where another is, and where it is itself once it is a root's
// corner: what was known of the other place is forgotten, which is told once.
TEST(MeshVertices, ARelocatedVertexIsItselfAgainAtARoot) {
    DenseGrid dense(32, 32, 2);
    ShadingCache& cache = dense.cache;
    const PatchId in_view = cache.root(ObjectId{0}, 777, true);
    const VertexId seen = cache.patch(in_view).corners[0];
    const VertexId hidden = coarsest(cache).front();
    ASSERT_FALSE(cache.of_root(hidden));
    EXPECT_TRUE(cache.of_root(seen));
    const SurfacePoint own = cache.surface_point(hidden);
    const std::uint32_t in_the_mesh = in_mesh(dense, hidden);
    const int level = cache.level(hidden);
    cache.relocate(hidden, seen);
    EXPECT_TRUE(cache.relocated(hidden));
    EXPECT_EQ(cache.surface_point(hidden).primitive, cache.surface_point(seen).primitive);
    EXPECT_EQ(cache.surface_point(hidden).u, cache.surface_point(seen).u);
    EXPECT_EQ(cache.level(hidden), level);  // it speaks for the same as before
    cache.store(hidden, 1, Rgb(2), 0, 64, 1);
    cache.mark_buried(hidden);
    cache.collapse(in_view);
    cache.pack();
    EXPECT_TRUE(cache.relocated(hidden));  // nothing was given up, so ids are the same
    cache.root(ObjectId{0}, 2, true);
    cache.root(ObjectId{0}, 777, true);
    EXPECT_TRUE(cache.evaluated(hidden, 1));
    EXPECT_TRUE(cache.take_forgotten().empty());

    cache.root(ObjectId{0}, own.primitive, true);
    EXPECT_EQ(in_mesh(dense, hidden), in_the_mesh);
    EXPECT_EQ(cache.surface_point(hidden).u, own.u);
    EXPECT_FALSE(cache.relocated(hidden));
    EXPECT_TRUE(cache.of_root(hidden));
    EXPECT_FALSE(cache.evaluated(hidden));
    EXPECT_FALSE(cache.vertex(hidden).buried);
    EXPECT_TRUE(cache.hollow(hidden, Shading::irradiance));  // none is above it
    EXPECT_EQ(cache.take_forgotten(), (std::vector<std::pair<VertexId, int>>{{hidden, 1}}));
    EXPECT_TRUE(cache.take_forgotten().empty());
    cache.resolve();
    EXPECT_EQ(luminance(cache.shown(seen, 1).value), 0);
    expect_consistent(cache);
}

// Weights add up to one on every level.
TEST(MeshVertices, AConstantOnTheCoarsestLevelIsOneEverywhere) {
    DenseGrid dense(32, 32, 2);
    const auto roots = front_roots(dense.cache);
    dense.cache.subdivide(roots[99]);
    const auto known = coarsest(dense.cache);
    EXPECT_LT(known.size(), 80u);  // of 1089
    for (const VertexId id : known) {
        dense.cache.store(id, 0, {2, 4, 8}, 0, 1, 1);
        dense.cache.store(id, 1, {16, 0, 1}, 0, 1, 1);
    }
    dense.cache.resolve();
    for (const VertexId id : all_vertices(dense.cache)) {
        EXPECT_EQ(dense.cache.shown(id, 0).value, Rgb(2, 4, 8));
        EXPECT_EQ(dense.cache.shown(id, 1).value, Rgb(16, 0, 1));
        EXPECT_EQ(dense.cache.shown_total(id).weight, 1);
    }
}

// As MeshLevels says, weights err by an eighth of a cell at most; what is shown is rounded to 1/512
// of its greatest channel on each of the levels, of which three have cells larger than a square.
TEST(MeshVertices, ALinearFunctionOnTheCoarsestLevelIsReproducedInside) {
    DenseGrid dense(48, 48);
    front_roots(dense.cache);
    for (const VertexId id : coarsest(dense.cache))
        dense.cache.store(id, 0, position(dense.cache, id), 0, 1, 1);
    dense.cache.resolve();
    const float cell = bounds(dense.scene).diagonal() / 10;
    int inside = 0;
    for (const VertexId id : all_vertices(dense.cache)) {
        const Vec3 p = position(dense.cache, id);
        if (std::min({p.x, 48 - p.x, p.y, 48 - p.y}) < 1.5f * cell) continue;
        EXPECT_LT(glm::length(Vec3(dense.cache.shown(id, 0).value) - p),
                  cell / 8 + 4 * 48.0f / 512);
        ++inside;
    }
    EXPECT_GT(inside, 600);
}

// Stores in any order, with looks at what changed in between, show to the bit what one pass over
// all shows: nothing that changed is passed over.
TEST(MeshVertices, ChangesAreCarriedAsOnePassOverAllWould) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        DenseGrid dense(20, 12, 2);
        Rng rng(seed);
        front_roots(dense.cache);
        subdivide_at_random(dense.cache, 60, rng);
        ShadingCache fresh = dense.cache;
        const auto count = static_cast<std::uint32_t>(dense.cache.vertices().size());
        std::set<VertexId> buried, exposed;
        std::vector<std::pair<std::pair<VertexId, int>, Rgb>> stored;
        for (int i = 0; i < 300; ++i) {
            const VertexId id{rng.below(count)};
            const int channel = static_cast<int>(rng.below(2));
            const Rgb value = 50.0f + 50.0f * Rgb(rng.uniform(), rng.uniform(), rng.uniform());
            stored.push_back({{id, channel}, value});
            dense.cache.store(id, channel, value, 1, 8, 1);
            if (rng.below(4) == 0) {
                dense.cache.mark_buried(id);
                buried.insert(id);
            }
            if (rng.below(8) == 0 && !buried.empty()) {
                dense.cache.expose(*buried.begin());
                exposed.insert(*buried.begin());
                buried.erase(buried.begin());
            }
            if (rng.below(4) == 0) {
                dense.cache.resolve();
                if (rng.below(2) == 0) dense.cache.forget_changes();
            }
        }
        dense.cache.resolve();
        std::stable_sort(stored.begin(), stored.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [where, value] : stored)
            fresh.store(where.first, where.second, value, 1, 8, 1);
        for (const VertexId id : exposed) fresh.expose(id);
        for (const VertexId id : buried) fresh.mark_buried(id);
        fresh.resolve();
        expect_same_shown(dense.cache, fresh);
    }
}

// One vertex at a time: the answer tells whether its children need to be looked at.
TEST(MeshVertices, ResolvingOneTellsWhetherItShowsSomethingElse) {
    DenseGrid dense(16, 16, 2);
    ShadingCache& cache = dense.cache;
    front_roots(cache);
    for (const VertexId id : coarsest(cache)) cache.store(id, 0, Rgb(4), 0, 1, 1);
    for (const VertexId id : coarsest(cache)) cache.store(id, 1, Rgb(0), 0, 1, 1);
    std::size_t predicted = 0;
    for (const VertexId id : all_vertices(cache)) {
        const bool is_predicted = !cache.parents(id).empty();
        EXPECT_EQ(cache.resolve(id, 0), is_predicted);
        EXPECT_FALSE(cache.resolve(id, 0));  // by now it is known
        EXPECT_FALSE(cache.resolve(id, 1));  // black, as before
        predicted += is_predicted ? 1 : 0;
    }
    EXPECT_GT(predicted, 200u);

    // To be hollow is news too: all but the first of a vertex's parents are buried, then that.
    const auto all = all_vertices(cache);
    const VertexId child = *std::find_if(all.begin(), all.end(), [&](VertexId id) {
        const auto parents = cache.parents(id);
        return parents.size() > 1 && std::all_of(parents.begin(), parents.end(), [&](VertexId p) {
                   return cache.parents(p).empty();
               });
    });
    const auto parents = cache.parents(child);
    for (std::size_t i = 1; i < parents.size(); ++i) cache.mark_buried(parents[i]);
    EXPECT_FALSE(cache.resolve(child, 0));  // the first still says 4
    cache.mark_buried(parents[0]);
    EXPECT_TRUE(cache.resolve(child, 0));
    EXPECT_EQ(cache.shown(child, 0).weight, 0);
}

// A vertex that agrees with its prediction is left a quarter of its parents' surplus; it was raised
// by what another child had missed.
TEST(MeshVertices, SuspicionOnlyGrowsAndIsInheritedByAQuarter) {
    DenseGrid dense(16, 16);
    ShadingCache& cache = dense.cache;
    front_roots(cache);
    for (const VertexId id : coarsest(cache)) {
        cache.store(id, 0, Rgb(8), 0, 1, 1);
        cache.suspect(id, 0, 2);  // less than it is suspected of: a part of all light
        EXPECT_GT(cache.surplus(id, 0), 2);
        cache.suspect(id, 0, 16);
        cache.suspect(id, 0, 4);
        EXPECT_EQ(cache.surplus(id, 0), 16);
    }
    cache.resolve();
    const auto all = all_vertices(cache);
    const VertexId child = *std::find_if(all.begin(), all.end(),
                                         [&](VertexId id) { return !cache.parents(id).empty(); });
    cache.store(child, 0, Rgb(8), 0, 1, 1);
    EXPECT_NEAR(cache.surplus(child, 0), 16 / 4, 1e-5f);
}

// Vertices of a mesh with two parents are no midpoints: an edge between these would share them.
TEST(MeshVertices, PackingMakesNoMidpointsOfThem) {
    DenseGrid dense(40, 1);  // so thin that vertices have parents to two sides only
    ShadingCache& cache = dense.cache;
    auto roots = front_roots(cache);
    cache.subdivide(roots[7]);
    cache.subdivide(roots[9]);
    for (const VertexId id : coarsest(cache)) cache.store(id, 0, Rgb(4), 0, 1, 1);
    cache.resolve();
    std::size_t of_two = 0;
    const auto expect_no_midpoints = [&] {
        of_two = 0;
        for (const VertexId id : all_vertices(cache)) {
            const auto parents = cache.parents(id);
            if (!cache.vertex(id).of_mesh || parents.size() != 2) continue;
            EXPECT_FALSE(cache.midpoint(parents[0], parents[1]).has_value());
            ++of_two;
        }
    };
    expect_no_midpoints();
    EXPECT_GT(of_two, 10u);
    cache.collapse(roots[7]);
    cache.pack();
    expect_no_midpoints();
    EXPECT_GT(of_two, 10u);
    expect_consistent(cache);
    // What is left is the mesh, all of it, and the midpoints of the patch that was kept.
    EXPECT_EQ(cache.patches().size(), 80u + 4);
    EXPECT_EQ(cache.vertices().size(), 82u + 3);
    EXPECT_EQ(front_roots(cache).size(), 80u);
    EXPECT_EQ(cache.vertices().size(), 82u + 3);
    for (const VertexId id : all_vertices(cache)) EXPECT_EQ(cache.shown(id, 0).value, Rgb(4));
}

}  // namespace
}  // namespace chiaro
