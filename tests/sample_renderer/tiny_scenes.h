// Small scenes whose answers are known, built in code.
#pragma once

#include "scene/scene.h"

#include <string>

namespace chiaro::tiny {

inline MaterialId add_material(Scene& scene, Rgb base_color, Rgb emission = Rgb(0)) {
    Material material;
    material.name = "material" + std::to_string(scene.materials.size());
    material.base_color = base_color;
    material.emission = emission;
    scene.materials.push_back(material);
    return static_cast<MaterialId>(scene.materials.size() - 1);
}

/// Materials that are not diffuse, by glTF.
inline Gloss metal(float roughness) {
    return {.model = GlossModel::metallic_roughness, .metallic = 1, .roughness = roughness};
}
inline Gloss plastic(float roughness) {
    return {.model = GlossModel::metallic_roughness, .metallic = 0, .roughness = roughness};
}
inline Gloss glass(float roughness, bool thin) {
    return {.model = GlossModel::metallic_roughness,
            .roughness = roughness,
            .transmission = 1,
            .thin = thin};
}

/// MTL's: reflects `specular` at any angle, sharply.
inline Gloss mirror(Rgb specular) {
    return {.model = GlossModel::phong, .specular = specular, .illumination_model = 3};
}

inline MaterialId add_glossy(Scene& scene, Rgb base_color, const Gloss& gloss) {
    const MaterialId id = add_material(scene, base_color);
    scene.materials[index_of(id)].gloss = gloss;
    return id;
}

inline Primitive quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                      MaterialId material) {
    return {{a, b, c, d}, material};
}
inline Primitive triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, MaterialId material) {
    return {{a, b, c, Primitive::kNoCorner}, material};
}

/// An object that shows `mesh` where it is; primitives are put in order.
inline ObjectId add_object(Scene& scene, Mesh mesh, const Mat4& to_world = Mat4(1)) {
    Object object;
    object.name = "object" + std::to_string(scene.objects.size());
    mesh.name = object.name;
    order_primitives(mesh);
    object.mesh = static_cast<MeshId>(scene.meshes.size());
    object.to_world = to_world;
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(object);
    return static_cast<ObjectId>(scene.objects.size() - 1);
}

/// A quad with corners `corner`, + `u`, + `u` + `v`, + `v`; its front is where cross(u, v) points.
inline ObjectId add_quad(Scene& scene, Vec3 corner, Vec3 u, Vec3 v, MaterialId material) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.primitives = {quad(0, 1, 2, 3, material)};
    return add_object(scene, std::move(mesh));
}

/// The six faces of a box, fronts outward; `inward` turns them. Faces: 0 z low, 1 z high, 2 y low,
/// 3 y high, 4 x low, 5 x high.
inline Mesh box_mesh(Vec3 low, Vec3 high, MaterialId material, bool inward) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.positions.push_back(
            {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& f : faces)
        mesh.primitives.push_back(inward ? quad(f[0], f[3], f[2], f[1], material)
                                         : quad(f[0], f[1], f[2], f[3], material));
    return mesh;
}
inline ObjectId add_room(Scene& scene, Vec3 low, Vec3 high, MaterialId material) {
    return add_object(scene, box_mesh(low, high, material, true));
}
inline ObjectId add_box(Scene& scene, Vec3 low, Vec3 high, MaterialId material) {
    return add_object(scene, box_mesh(low, high, material, false));
}

inline PunctualLight point_light(Vec3 position, Rgb candela) {
    PunctualLight light;
    light.kind = LightKind::point;
    light.position = position;
    light.intensity = candela;
    return light;
}
inline PunctualLight sun(Vec3 direction, Rgb lux) {
    PunctualLight light;
    light.kind = LightKind::directional;
    light.direction = glm::normalize(direction);
    light.intensity = lux;
    return light;
}

/// The Cornell box as measured at Cornell, a hundredth of the published size; its lamp in cd/m2.
inline Scene cornell_box() {
    Scene scene;
    const MaterialId white = add_material(scene, {0.725f, 0.71f, 0.68f});
    const MaterialId green = add_material(scene, {0.14f, 0.45f, 0.091f});
    const MaterialId red = add_material(scene, {0.63f, 0.065f, 0.05f});
    const MaterialId lamp = add_material(scene, Rgb(0), {17, 12, 4});
    const auto add = [&scene](std::vector<Vec3> corners, MaterialId material) {
        Mesh mesh;
        mesh.positions = std::move(corners);
        for (std::uint32_t i = 0; i < mesh.positions.size(); i += 4)
            mesh.primitives.push_back(quad(i, i + 1, i + 2, i + 3, material));
        add_object(scene, std::move(mesh));
    };
    add({{5.528f, 0, 0},
         {0, 0, 0},
         {0, 0, 5.592f},
         {5.496f, 0, 5.592f},
         {5.56f, 5.488f, 0},
         {5.56f, 5.488f, 5.592f},
         {0, 5.488f, 5.592f},
         {0, 5.488f, 0},
         {5.496f, 0, 5.592f},
         {0, 0, 5.592f},
         {0, 5.488f, 5.592f},
         {5.56f, 5.488f, 5.592f}},
        white);
    add({{1.3f, 1.65f, 0.65f}, {0.82f, 1.65f, 2.25f}, {2.4f, 1.65f, 2.72f},  {2.9f, 1.65f, 1.14f},
         {2.9f, 0, 1.14f},     {2.9f, 1.65f, 1.14f},  {2.4f, 1.65f, 2.72f},  {2.4f, 0, 2.72f},
         {1.3f, 0, 0.65f},     {1.3f, 1.65f, 0.65f},  {2.9f, 1.65f, 1.14f},  {2.9f, 0, 1.14f},
         {0.82f, 0, 2.25f},    {0.82f, 1.65f, 2.25f}, {1.3f, 1.65f, 0.65f},  {1.3f, 0, 0.65f},
         {2.4f, 0, 2.72f},     {2.4f, 1.65f, 2.72f},  {0.82f, 1.65f, 2.25f}, {0.82f, 0, 2.25f}},
        white);
    add({{4.23f, 3.3f, 2.47f}, {2.65f, 3.3f, 2.96f}, {3.14f, 3.3f, 4.56f}, {4.72f, 3.3f, 4.06f},
         {4.23f, 0, 2.47f},    {4.23f, 3.3f, 2.47f}, {4.72f, 3.3f, 4.06f}, {4.72f, 0, 4.06f},
         {4.72f, 0, 4.06f},    {4.72f, 3.3f, 4.06f}, {3.14f, 3.3f, 4.56f}, {3.14f, 0, 4.56f},
         {3.14f, 0, 4.56f},    {3.14f, 3.3f, 4.56f}, {2.65f, 3.3f, 2.96f}, {2.65f, 0, 2.96f},
         {2.65f, 0, 2.96f},    {2.65f, 3.3f, 2.96f}, {4.23f, 3.3f, 2.47f}, {4.23f, 0, 2.47f}},
        white);
    add({{0, 0, 5.592f}, {0, 0, 0}, {0, 5.488f, 0}, {0, 5.488f, 5.592f}}, green);
    add({{5.528f, 0, 0}, {5.496f, 0, 5.592f}, {5.56f, 5.488f, 5.592f}, {5.56f, 5.488f, 0}}, red);
    add({{3.43f, 5.483f, 2.27f},
         {3.43f, 5.483f, 3.32f},
         {2.13f, 5.483f, 3.32f},
         {2.13f, 5.483f, 2.27f}},
        lamp);
    return scene;
}

}  // namespace chiaro::tiny
