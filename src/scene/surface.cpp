#include "scene/surface.h"

#include "scene/bicubic_mesh.h"

namespace chiaro {
namespace {

// Half of a quad, or a triangle: its corners in the order of the winding.
struct Half {
    Vec3 a, b, c;
    Vec3 cross() const { return glm::cross(b - a, c - a); }
};

Vec3 corner_position(const Mesh& mesh, const Primitive& primitive, int corner) {
    return mesh.positions[primitive.corners[corner]];
}

Half half_of(const Mesh& mesh, const Primitive& primitive, const CornerWeights& w) {
    return {corner_position(mesh, primitive, w.corners[0]),
            corner_position(mesh, primitive, w.corners[1]),
            corner_position(mesh, primitive, w.corners[2])};
}

template <typename T>
T blend(const std::vector<T>& values, const Primitive& primitive, const CornerWeights& w) {
    return w.weights[0] * values[primitive.corners[w.corners[0]]] +
           w.weights[1] * values[primitive.corners[w.corners[1]]] +
           w.weights[2] * values[primitive.corners[w.corners[2]]];
}

// In object space; along the front side's normal.
Vec3 front_direction(const Mesh& mesh, const SurfacePoint& point) {
    if (is_bicubic(mesh, point.primitive))
        return patch_normal(mesh.bicubics[point.primitive], {point.u, point.v});
    const Primitive& primitive = mesh.primitives[point.primitive];
    return front_cross(mesh, primitive, corner_weights(primitive.is_quad(), point.u, point.v));
}

Vec4 texture_value(const Scene& scene, const TextureUse& use, const Mesh& mesh,
                   const Primitive& primitive, const CornerWeights& w) {
    const std::vector<Vec2>& uvs = mesh.uvs[use.uv_set & 1];
    const Vec2 uv = uvs.empty() ? Vec2(0) : blend(uvs, primitive, w);
    return sample_texture(scene.texture(use.texture), use.transform(uv));
}

// The mean of a texture's colours, whatever its alpha, which emission has no part of in glTF.
Rgb plain_mean(const Texture& texture) {
    std::array<std::array<double, 256>, 3> counts = {};
    for (const auto& texel : texture.texels)
        for (int c = 0; c < 3; ++c) ++counts[c][texel[c]];
    glm::dvec3 sum(0);
    for (int level = 0; level < 256; ++level) {
        const float encoded = static_cast<float>(level) / 255;
        const float value = texture.srgb ? srgb_to_linear(encoded) : encoded;
        for (int c = 0; c < 3; ++c) sum[c] += counts[c][level] * value;
    }
    return Rgb(sum / static_cast<double>(texture.texels.size()));
}

}  // namespace

CornerWeights corner_weights(bool is_quad, float u, float v) {
    if (!is_quad) return {{0, 1, 2}, {1 - u - v, u, v}};
    if (u + v <= 1) return {{0, 1, 3}, {1 - u - v, u, v}};
    return {{2, 3, 1}, {u + v - 1, 1 - u, 1 - v}};
}

Vec3 front_cross(const Mesh& mesh, const Primitive& primitive, const CornerWeights& w) {
    const Vec3 cross = half_of(mesh, primitive, w).cross();
    if (!primitive.is_quad() || cross != Vec3(0)) return cross;
    const CornerWeights other = corner_weights(true, w.corners[0] == 0 ? 1.0f : 0.0f, 0.5f);
    return half_of(mesh, primitive, other).cross();
}

Mat3 normal_matrix(const Mat4& to_world) {
    // The cofactors are the inverse transpose times the determinant: no division, and its sign
    // keeps the front on the file's counter-clockwise side when the transform mirrors.
    const Vec3 x(to_world[0]), y(to_world[1]), z(to_world[2]);
    const Vec3 yz = glm::cross(y, z);
    const float sign = glm::dot(x, yz) < 0 ? -1.0f : 1.0f;
    return {sign * yz, sign * glm::cross(z, x), sign * glm::cross(x, y)};
}

Vec3 shading_normal(const Scene& scene, const SurfacePoint& point, Vec3 geometric_normal) {
    const Object& object = scene.objects[index_of(point.object)];
    const Mesh& mesh = scene.mesh_of(object);
    const bool curved = is_bicubic(mesh, point.primitive);
    if (!curved && mesh.normals.empty()) return geometric_normal;

    const Primitive& primitive = mesh.primitives[point.primitive];
    const CornerWeights w = corner_weights(primitive.is_quad(), point.u, point.v);
    const Vec3 smooth = curved ? front_direction(mesh, point) : blend(mesh.normals, primitive, w);
    const Vec3 normal = safe_normalize(normal_matrix(object.to_world) * smooth, geometric_normal);
    const float side = glm::dot(normal, geometric_normal);
    if (side == 0) return geometric_normal;
    return side < 0 ? -normal : normal;
}

Vec3 surface_position(const Scene& scene, const SurfacePoint& point) {
    const Object& object = scene.objects[index_of(point.object)];
    const Mesh& mesh = scene.mesh_of(object);
    if (is_bicubic(mesh, point.primitive))
        return Vec3(object.to_world *
                    Vec4(patch_position(mesh.bicubics[point.primitive], {point.u, point.v}), 1));
    const Primitive& primitive = mesh.primitives[point.primitive];
    const CornerWeights w = corner_weights(primitive.is_quad(), point.u, point.v);
    return Vec3(object.to_world * Vec4(blend(mesh.positions, primitive, w), 1));
}

SurfaceTangents surface_tangents(const Scene& scene, const SurfacePoint& point) {
    const Object& object = scene.objects[index_of(point.object)];
    const Mesh& mesh = scene.mesh_of(object);
    const Mat3 linear(object.to_world);
    if (is_bicubic(mesh, point.primitive)) {
        const PatchPoint p = patch_point(mesh.bicubics[point.primitive], {point.u, point.v});
        return {linear * p.du, linear * p.dv};
    }
    const Primitive& primitive = mesh.primitives[point.primitive];
    const CornerWeights w = corner_weights(primitive.is_quad(), point.u, point.v);
    const Half half = half_of(mesh, primitive, w);
    const float sign = w.corners[0] == 2 ? -1.0f : 1.0f;  // past a quad's diagonal
    return {linear * (sign * (half.b - half.a)), linear * (sign * (half.c - half.a))};
}

SurfaceGeometry surface_geometry(const Scene& scene, const SurfacePoint& point) {
    const Object& object = scene.objects[index_of(point.object)];
    const Mesh& mesh = scene.mesh_of(object);
    const Primitive& primitive = mesh.primitives[point.primitive];

    SurfaceGeometry geometry;
    geometry.position = surface_position(scene, point);
    geometry.geometric_normal = safe_normalize(
        normal_matrix(object.to_world) * front_direction(mesh, point), Vec3(0, 0, 1));
    geometry.shading_normal = shading_normal(scene, point, geometry.geometric_normal);
    geometry.primitive = &primitive;
    geometry.material = &scene.material(primitive.material);
    return geometry;
}

MaterialId material_of(const Scene& scene, const SurfacePoint& point) {
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(point.object)]);
    return mesh.primitives[point.primitive].material;
}

Vec4 base_color(const Scene& scene, const SurfacePoint& point) {
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(point.object)]);
    const Primitive& primitive = mesh.primitives[point.primitive];
    const Material& material = scene.material(primitive.material);
    Vec4 color(material.base_color, material.alpha);
    if (!material.base_color_texture.used() && mesh.colors.empty()) return color;

    const CornerWeights w = corner_weights(primitive.is_quad(), point.u, point.v);
    if (material.base_color_texture.used())
        color *= texture_value(scene, material.base_color_texture, mesh, primitive, w);
    if (!mesh.colors.empty()) color *= blend(mesh.colors, primitive, w);
    return glm::clamp(color, Vec4(0), Vec4(1));
}

float opacity(const Scene& scene, const SurfacePoint& point) {
    const Material& material = scene.material(material_of(scene, point));
    if (!material.see_through()) return 1;
    const float alpha = base_color(scene, point).a;
    if (material.alpha_mode == AlphaMode::blend) return alpha;
    return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
}

Vec2 metallic_roughness(const Scene& scene, const SurfacePoint& point) {
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(point.object)]);
    const Primitive& primitive = mesh.primitives[point.primitive];
    const Gloss& gloss = scene.material(primitive.material).gloss;
    const Vec2 factors(gloss.metallic, gloss.roughness);
    if (!gloss.metallic_roughness.used()) return factors;
    const CornerWeights w = corner_weights(primitive.is_quad(), point.u, point.v);
    const Vec4 texel = texture_value(scene, gloss.metallic_roughness, mesh, primitive, w);
    return factors * Vec2(texel.b, texel.g);
}

Rgb mean_reflectance(const Scene& scene, const Material& material) {
    const TextureUse& use = material.base_color_texture;
    return use.used() ? material.base_color * mean_color(scene.texture(use.texture))
                      : material.base_color;
}

Rgb emission(const Scene& scene, const SurfacePoint& point, bool front) {
    const Object& object = scene.objects[index_of(point.object)];
    const Mesh& mesh = scene.mesh_of(object);
    const Primitive& primitive = mesh.primitives[point.primitive];
    const Material& material = scene.material(primitive.material);
    if (!front && !material.emits_backward) return Rgb(0);
    const Rgb plain = object.emission_scale * material.emission;
    if (!material.emission_texture.used()) return plain;
    const CornerWeights w = corner_weights(primitive.is_quad(), point.u, point.v);
    return plain * Rgb(texture_value(scene, material.emission_texture, mesh, primitive, w));
}

Rgb mean_emission(const Scene& scene, const Material& material) {
    const TextureUse& use = material.emission_texture;
    return use.used() ? material.emission * plain_mean(scene.texture(use.texture))
                      : material.emission;
}

float primitive_area(const Scene& scene, ObjectId object_id, std::uint32_t primitive_index) {
    const Object& object = scene.objects[index_of(object_id)];
    const Mesh& mesh = scene.mesh_of(object);
    const Primitive& primitive = mesh.primitives[primitive_index];
    const Mat3 cofactors = normal_matrix(object.to_world);
    if (is_bicubic(mesh, primitive_index)) {
        // By the midpoint rule.
        constexpr int kAcross = 16;
        float sum = 0;
        for (int j = 0; j < kAcross; ++j)
            for (int i = 0; i < kAcross; ++i) {
                const Vec2 uv = (Vec2(i, j) + 0.5f) / static_cast<float>(kAcross);
                const PatchPoint p = patch_point(mesh.bicubics[primitive_index], uv);
                sum += glm::length(cofactors * glm::cross(p.du, p.dv));
            }
        return sum / (kAcross * kAcross);
    }
    const auto half_area = [&](float u) {
        const CornerWeights w = corner_weights(primitive.is_quad(), u, u);
        return 0.5f * glm::length(cofactors * half_of(mesh, primitive, w).cross());
    };
    return half_area(0) + (primitive.is_quad() ? half_area(1) : 0.0f);
}

}  // namespace chiaro
