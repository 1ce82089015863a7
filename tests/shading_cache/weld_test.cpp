// Which corners of a mesh are one vertex of the cache.
#include "shading_cache/cache_testing.h"
#include "shading_cache/fold.h"

#include <cmath>

namespace chiaro {
namespace {

using namespace tiny;

std::size_t vertices_of(const Scene& scene) {
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    front_roots(cache);
    return cache.vertices().size();
}
std::size_t vertices_of_fold(float degrees, bool normals) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(0.5f));
    add_object(scene, folded(degrees, normals, material, material));
    return vertices_of(scene);
}

// Two squares have 8 corners, 6 if those at the common edge are one vertex each.
TEST(Weld, CornersOfACoplanarNeighbourAreOneVertex) {
    EXPECT_EQ(vertices_of(grid(2, 1)), 6u);
    EXPECT_EQ(vertices_of_fold(0, false), 6u);
    EXPECT_EQ(vertices_of_fold(0, true), 6u);
}

TEST(Weld, ACreaseOfNinetyDegreesStaysSharp) {
    EXPECT_EQ(vertices_of_fold(90, false), 8u);
    EXPECT_EQ(vertices_of_fold(90, true), 8u);
}

// Normals of the file within 16 degrees are one smooth surface; a flat face ends at any crease that
// shows (1 degree).
TEST(Weld, SmoothNormalsAreJoinedUpToSixteenDegrees) {
    EXPECT_EQ(vertices_of_fold(15, true), 6u);
    EXPECT_EQ(vertices_of_fold(17, true), 8u);
    EXPECT_EQ(vertices_of_fold(15, false), 8u);
    EXPECT_EQ(vertices_of_fold(0.5f, false), 6u);
}

TEST(Weld, OtherMaterialsStayApart) {
    Scene scene;
    const MaterialId one = add_material(scene, Rgb(0.5f));
    const MaterialId other = add_material(scene, Rgb(0.7f));
    add_object(scene, folded(0, false, one, other));
    EXPECT_EQ(vertices_of(scene), 8u);
}

TEST(Weld, OtherObjectsStayApart) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(0.5f));
    add_quad(scene, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, material);
    add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, material);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    cache.root(ObjectId{0}, 0, true);
    cache.root(ObjectId{1}, 0, true);
    EXPECT_EQ(cache.vertices().size(), 8u);
}

// The back of a surface is lit by other light: vertices of its own, shared among backs.
TEST(Weld, SidesStayApart) {
    const Scene scene = grid(2, 1);
    const MeshGraphs graphs(scene, CoarserLevels::none, 1);
    ShadingCache cache(scene, graphs, {1}, SplitRule::always_four);
    const auto fronts = front_roots(cache);
    const PatchId back = cache.root(ObjectId{0}, 0, false);
    EXPECT_NE(back, fronts[0]);
    EXPECT_EQ(cache.vertices().size(), 6u + 4);
    cache.root(ObjectId{0}, 1, false);
    EXPECT_EQ(cache.vertices().size(), 6u + 6);
    EXPECT_TRUE(cache.on_front(cache.patch(fronts[0]).corners[0]));
    EXPECT_FALSE(cache.on_front(cache.patch(back).corners[0]));
    // Neither do their edges share midpoints.
    cache.subdivide(fronts[0]);
    cache.subdivide(back);
    EXPECT_EQ(cache.vertices().size(), 12u + 5 + 5);
}

// Zero and minus zero are one place.
TEST(Weld, SignedZeroIsOnePlace) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(0.5f));
    Mesh mesh = folded(0, false, material, material);
    mesh.positions[4] = {-0.0f, -0.0f, -0.0f};
    add_object(scene, std::move(mesh));
    EXPECT_EQ(vertices_of(scene), 6u);
}

// A closed box is creased at all edges: 6 faces of 4 corners; a fine smooth sphere has none.
TEST(Weld, ABoxHasFourVerticesAFace) {
    Scene scene;
    add_box(scene, Vec3(0), Vec3(1), add_material(scene, Rgb(0.5f)));
    EXPECT_EQ(vertices_of(scene), 24u);
}

}  // namespace
}  // namespace chiaro
