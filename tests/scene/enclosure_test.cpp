#include "scene/enclosure.h"

#include "sample_renderer/tiny_scenes.h"
#include "scene/bicubic_mesh.h"
#include "scene/curved_shapes.h"

#include <gtest/gtest.h>

namespace chiaro {
namespace {

constexpr MaterialId kGlass{0}, kOther{1};

Mesh box(bool inward = false) {
    return tiny::box_mesh(Vec3(-3, 4, 5), Vec3(-2, 6, 8), kGlass, inward);
}

// Each corner of each face a point of its own, as where normals or texture coordinates jump.
Mesh split_points(const Mesh& mesh) {
    Mesh split;
    for (Primitive p : mesh.primitives) {
        for (int i = 0; i < p.corner_count(); ++i) {
            split.positions.push_back(mesh.positions[p.corners[i]]);
            p.corners[i] = static_cast<std::uint32_t>(split.positions.size() - 1);
        }
        split.primitives.push_back(p);
    }
    return split;
}

// Every edge of a box has a face on either side, until one is taken away.
TEST(Enclosure, ABoxEnclosesAVolumeAndAnOpenOneDoesNot) {
    Mesh mesh = box();
    EXPECT_TRUE(encloses_volume(mesh, kGlass));
    EXPECT_TRUE(encloses_volume(split_points(mesh), kGlass));
    EXPECT_FALSE(encloses_volume(mesh, kOther));
    mesh.primitives.pop_back();
    EXPECT_FALSE(encloses_volume(mesh, kGlass));
}

// A sphere of patches encloses what its surface does, not what its corners do; a lens whose corners
// lie in a plane encloses something too.
TEST(Enclosure, PatchesEncloseWhatIsBehindTheirSurface) {
    Mesh sphere = curved_sphere(0.5f);
    EXPECT_TRUE(encloses_volume(sphere, MaterialId{0}));
    Mesh lens;
    for (const float side : {1.0f, -1.0f}) {
        std::array<Vec3, 16> points;
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const bool inside = i % 3 != 0 && j % 3 != 0;
                points[4 * j + i] = {i, j, inside ? 0.4f * side : 0.0f};
            }
        BicubicPatch patch = make_bicubic(points);
        add_bicubic(lens, side > 0 ? patch : flipped(patch), MaterialId{0});
    }
    order_primitives(lens);
    EXPECT_TRUE(encloses_volume(lens, MaterialId{0}));
    for (BicubicPatch& patch : lens.bicubics) patch = flipped(patch);
    for (Primitive& p : lens.primitives) std::swap(p.corners[1], p.corners[3]);
    EXPECT_FALSE(encloses_volume(lens, MaterialId{0}));  // inward
}

// Fronts that look inward, or not all alike, do not say which side is the glass.
TEST(Enclosure, TheFrontsMustBeOutward) {
    EXPECT_FALSE(encloses_volume(box(true), kGlass));
    Mesh mesh = box();
    std::swap(mesh.primitives[2].corners[1], mesh.primitives[2].corners[3]);
    EXPECT_FALSE(encloses_volume(mesh, kGlass));
}

// Another material's faces are no part of the surface; triangles beside quads are.
TEST(Enclosure, OnlyTheMaterialsOwnFacesCount) {
    Mesh mesh = box();
    const Primitive lid = mesh.primitives[3];
    mesh.primitives[3] = tiny::triangle(lid.corners[0], lid.corners[1], lid.corners[2], kGlass);
    mesh.primitives.push_back(
        tiny::triangle(lid.corners[0], lid.corners[2], lid.corners[3], kGlass));
    EXPECT_TRUE(encloses_volume(mesh, kGlass));
    mesh.primitives[3].material = kOther;
    EXPECT_FALSE(encloses_volume(mesh, kGlass));
}

// Glass is solid where it is closed in all that it is used for; what does not transmit is left.
TEST(Enclosure, GlassIsThinWhereItIsOpenAnywhere) {
    Scene scene;
    for (int i = 0; i < 2; ++i) tiny::add_material(scene, Rgb(1));
    scene.materials[0].gloss.transmission = 1;
    tiny::add_object(scene, box());
    decide_thin(scene);
    EXPECT_FALSE(scene.materials[0].gloss.thin);
    EXPECT_TRUE(scene.materials[1].gloss.thin);
    tiny::add_quad(scene, Vec3(0), {1, 0, 0}, {0, 1, 0}, kGlass);
    decide_thin(scene);
    EXPECT_TRUE(scene.materials[0].gloss.thin);
}

}  // namespace
}  // namespace chiaro
