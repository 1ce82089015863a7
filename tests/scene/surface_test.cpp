#include "scene/surface.h"

#include "sample_renderer/tiny_scenes.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace chiaro {
namespace {

using tiny::add_material;
using tiny::add_object;

void expect_near(Vec3 a, Vec3 b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

// A quad that is not flat, and a triangle, in one mesh.
Scene bent_quad_and_triangle(const Mat4& to_world = Mat4(1)) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(0.5f));
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 1}, {0, 2, 0}};
    mesh.primitives = {tiny::quad(0, 1, 2, 3, material), tiny::triangle(0, 1, 3, material)};
    add_object(scene, std::move(mesh), to_world);
    return scene;
}

// The weights of a quad's map sum to 1 and give the corners at the corners of the unit square.
TEST(Surface, QuadMapMeetsItsCorners) {
    const Scene scene = bent_quad_and_triangle();
    const auto at = [&](float u, float v) {
        return surface_geometry(scene, {ObjectId(0), 0, u, v}).position;
    };
    expect_near(at(0, 0), {0, 0, 0});
    expect_near(at(1, 0), {2, 0, 0});
    expect_near(at(1, 1), {2, 2, 1});
    expect_near(at(0, 1), {0, 2, 0});
    expect_near(at(0.5f, 0.5f), {1, 1, 0});  // the diagonal 1-3 belongs to both halves
    expect_near(at(0.75f, 0.75f), {1.5f, 1.5f, 0.5f});
}

// Each half of a bent quad has its own geometric normal.
TEST(Surface, NormalsOfTheHalves) {
    const Scene scene = bent_quad_and_triangle();
    const auto normal = [&](float uv) {
        return surface_geometry(scene, {ObjectId(0), 0, uv, uv}).geometric_normal;
    };
    expect_near(normal(0.2f), {0, 0, 1});
    expect_near(normal(0.8f), glm::normalize(glm::cross(Vec3(-2, 0, -1), Vec3(0, -2, -1))));
}

// Normals stay perpendicular to the surface under a stretch, which turning them with the points
// would break; a mirror keeps the front where the file's winding puts it (glTF 2.0, 3.7.4).
TEST(Surface, NormalsUnderStretchAndMirror) {
    Mat4 stretch(1);
    stretch[2] = {0.5f, 0, 3, 0};
    const Scene stretched = bent_quad_and_triangle(stretch);
    for (const float uv : {0.2f, 0.8f}) {
        const auto at = [&](float u, float v) {
            return surface_geometry(stretched, {ObjectId(0), 0, u, v});
        };
        const Vec3 n = at(uv, uv).geometric_normal;
        EXPECT_NEAR(glm::dot(n, at(uv + 0.05f, uv).position - at(uv, uv).position), 0, 1e-5);
        EXPECT_NEAR(glm::dot(n, at(uv, uv + 0.05f).position - at(uv, uv).position), 0, 1e-5);
        EXPECT_NEAR(glm::length(n), 1, 1e-6);
    }
    const Scene mirrored = bent_quad_and_triangle(glm::scale(Mat4(1), Vec3(-1, 1, 1)));
    expect_near(surface_geometry(mirrored, {ObjectId(0), 0, 0.2f, 0.2f}).geometric_normal,
                {0, 0, 1});
}

// Interpolated normals are blended, normalised and kept on the geometric normal's side.
TEST(Surface, ShadingNormalsAreInterpolated) {
    Scene scene;
    const MaterialId material = add_material(scene, Rgb(0.5f));
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals = {{0, 0, 1}, glm::normalize(Vec3(1, 0, 1)), {0, 0, -1}};
    mesh.primitives = {tiny::triangle(0, 1, 2, material)};
    add_object(scene, mesh);
    const auto shading = [&](float u, float v) {
        return surface_geometry(scene, {ObjectId(0), 0, u, v}).shading_normal;
    };
    expect_near(shading(0, 0), {0, 0, 1});
    expect_near(shading(1, 0), glm::normalize(Vec3(1, 0, 1)));
    expect_near(shading(0.5f, 0), glm::normalize(Vec3(0, 0, 1) + glm::normalize(Vec3(1, 0, 1))));
    expect_near(shading(0, 1), {0, 0, 1});     // turned to the front
    expect_near(shading(0, 0.5f), {0, 0, 1});  // opposite normals cancel: the geometric one
}

// Base colour is the product of factor, texture and vertex colour, alpha alike.
TEST(Surface, BaseColorIsAProduct) {
    Scene scene;
    const MaterialId material = add_material(scene, {0.5f, 1, 1});
    Texture texture;
    texture.width = texture.height = 1;
    texture.texels = {{255, 255, 0, 51}};
    scene.textures.push_back(texture);
    scene.materials[0].alpha = 0.5f;
    scene.materials[0].base_color_texture.texture = TextureId(0);
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.uvs[0] = {{0, 0}, {1, 0}, {0, 1}};
    mesh.colors = {{1, 1, 1, 1}, {1, 0, 1, 1}, {1, 1, 1, 1}};
    mesh.primitives = {tiny::triangle(0, 1, 2, material)};
    add_object(scene, mesh);
    const Vec4 color = base_color(scene, {ObjectId(0), 0, 0.5f, 0});
    expect_near(Vec3(color), {0.5f, 0.5f, 0});
    EXPECT_NEAR(color.a, 0.1f, 1e-6f);
}

// Opaque surfaces stop all, masked ones all or nothing at the cutoff, blended ones their alpha.
TEST(Surface, OpacityFollowsTheAlphaMode) {
    Scene scene;
    tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, add_material(scene, Rgb(1)));
    const auto found = [&](AlphaMode mode, float alpha) {
        scene.materials[0].alpha_mode = mode;
        scene.materials[0].alpha = alpha;
        return opacity(scene, {ObjectId(0), 0, 0.5f, 0.5f});
    };
    EXPECT_EQ(found(AlphaMode::opaque, 0.25f), 1);
    EXPECT_EQ(found(AlphaMode::blend, 0.25f), 0.25f);
    EXPECT_EQ(found(AlphaMode::mask, 0.25f), 0);
    EXPECT_EQ(found(AlphaMode::mask, 0.5f), 1);
}

// Vectors whose squares are no floats are brought to unit length all the same.
TEST(Surface, NormalizesAnyLength) {
    for (const float length : {1e-37f, 1e-25f, 1e-10f, 1.0f, 1e25f, 1e37f})
        expect_near(safe_normalize(length * Vec3(3, 0, -4), Vec3(0)), {0.6f, 0, -0.8f});
    expect_near(safe_normalize(Vec3(0), {1, 0, 0}), {1, 0, 0});
}

// Emission leaves the front only, unless the material emits backward.
TEST(Surface, EmissionHasASide) {
    Scene scene;
    const MaterialId lamp = add_material(scene, Rgb(0), {3, 2, 1});
    tiny::add_quad(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, lamp);
    expect_near(emission(scene, {ObjectId(0), 0, 0.5f, 0.5f}, true), {3, 2, 1});
    expect_near(emission(scene, {ObjectId(0), 0, 0.5f, 0.5f}, false), {0, 0, 0});
    scene.materials[0].emits_backward = true;
    expect_near(emission(scene, {ObjectId(0), 0, 0.5f, 0.5f}, false), {3, 2, 1});
}

// Areas are those of the halves in world space.
TEST(Surface, AreaInWorldSpace) {
    const Scene plain = bent_quad_and_triangle();
    EXPECT_NEAR(primitive_area(plain, ObjectId(0), 1), 2, 1e-5);
    EXPECT_NEAR(primitive_area(plain, ObjectId(0), 0), 2 + 0.5 * std::sqrt(4 + 4 + 16), 1e-5);
    const Scene scaled = bent_quad_and_triangle(glm::scale(Mat4(1), Vec3(-3)));
    EXPECT_NEAR(primitive_area(scaled, ObjectId(0), 1), 18, 1e-4);
}

}  // namespace
}  // namespace chiaro
