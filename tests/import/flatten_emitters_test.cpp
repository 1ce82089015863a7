// Curved light sources become polygons that are as near and as large as the surface.
#include "import/flatten_emitters.h"

#include "import/finish_scene.h"
#include "import/import_testing.h"
#include "scene/curved_shapes.h"

#include <numbers>

namespace chiaro {
namespace {

Scene sphere_scene(float radius, Rgb emission) {
    Scene scene;
    scene.materials.emplace_back().emission = emission;
    scene.meshes.push_back(curved_sphere(radius));
    for (Primitive& primitive : scene.meshes[0].primitives) primitive.material = MaterialId{0};
    scene.objects.push_back({"ball", MeshId{0}, Mat4(1)});
    return scene;
}

TEST(FlattenEmitters, AGlowingSphereIsPolygonsOfItsAreaWithItsNormals) {
    Scene scene = sphere_scene(2, Rgb(5));
    finish_scene(scene, {}, "ball");
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_TRUE(mesh.bicubics.empty());
    ASSERT_FALSE(mesh.primitives.empty());
    const float tolerance = 4 * std::sqrt(3.0f) / 4000;
    float area = 0;
    for (const Primitive& p : mesh.primitives) {
        const auto at = [&](int c) { return mesh.positions[p.corners[c % p.corner_count()]]; };
        for (int c = 1; c + 1 < p.corner_count(); ++c)
            area += 0.5f * glm::length(glm::cross(at(c) - at(0), at(c + 1) - at(0)));
        for (int c = 0; c < p.corner_count(); ++c) {
            EXPECT_NEAR(glm::length(at(c)), 2, tolerance);
            EXPECT_NEAR(glm::length(0.5f * (at(c) + at(c + 1))), 2, tolerance);
            EXPECT_GT(glm::dot(mesh.normals[p.corners[c]], at(c)), 1.999f);
        }
    }
    EXPECT_NEAR(area / (16 * std::numbers::pi_v<float>), 1, 1e-3f);
}

TEST(FlattenEmitters, ADarkSphereStaysCurved) {
    Scene scene = sphere_scene(2, Rgb(0));
    finish_scene(scene, {}, "ball");
    EXPECT_EQ(scene.meshes.at(0).bicubics.size(), scene.meshes.at(0).primitives.size());
}

}  // namespace
}  // namespace chiaro
