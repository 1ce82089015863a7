#include "import/lamp_shape.h"

#include "scene/bicubic_mesh.h"
#include "scene/surface.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// Calls add(a, b, c) for triangles that the primitive consists of, object space; those of a
// bicubic patch are near it.
template <typename Add>
void for_each_triangle(const Mesh& mesh, std::uint32_t index, const Add& add) {
    const Primitive& primitive = mesh.primitives[index];
    if (is_bicubic(mesh, index)) {
        constexpr int kAcross = 8;
        const auto place = [&](int i, int j) {
            return patch_position(mesh.bicubics[index], Vec2(i, j) / static_cast<float>(kAcross));
        };
        for (int j = 0; j < kAcross; ++j)
            for (int i = 0; i < kAcross; ++i) {
                add(place(i, j), place(i + 1, j), place(i, j + 1));
                add(place(i + 1, j + 1), place(i, j + 1), place(i + 1, j));
            }
        return;
    }
    const auto corner = [&](int i) { return mesh.positions[primitive.corners[i]]; };
    if (!primitive.is_quad()) return add(corner(0), corner(1), corner(2));
    add(corner(0), corner(1), corner(3));
    add(corner(2), corner(3), corner(1));
}

template <typename Add>
void for_each_emitting(const Mesh& mesh, std::span<const Material> materials, const Add& add) {
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
        const Material& material = materials[index_of(mesh.primitives[p].material)];
        if (material.emissive()) add(p, material);
    }
}

}  // namespace

std::optional<Vec3> LampShape::normal() const {
    // A box that shines on all sides has none but what rounding leaves.
    if (!(glm::length(vector_area) > 1e-3 * area)) return std::nullopt;
    return Vec3(glm::normalize(vector_area));
}

void add_lamp(const Mesh& mesh, const Mat4& to_world, std::span<const Material> materials,
              const Scene& scene, LampShape& shape) {
    const glm::dmat4 m(to_world);
    const glm::dmat3 cofactors(normal_matrix(to_world));
    for_each_emitting(mesh, materials, [&](std::uint32_t p, const Material& material) {
        double area = 0;
        for_each_triangle(mesh, p, [&](Vec3 a, Vec3 b, Vec3 c) {
            const glm::dvec3 twice = cofactors * glm::cross(glm::dvec3(b - a), glm::dvec3(c - a));
            shape.vector_area += 0.5 * twice;
            area += 0.5 * glm::length(twice);
        });
        shape.area += area;
        shape.emitted += area * glm::dvec3(mean_emission(scene, material));
        const Primitive& primitive = mesh.primitives[p];
        const int count = primitive.corner_count();
        for (int i = 0; i < count; ++i) {
            const Vec3 side = mesh.positions[primitive.corners[(i + 1) % count]] -
                              mesh.positions[primitive.corners[i]];
            const glm::dvec3 edge = glm::dmat3(m) * glm::dvec3(side);
            // Of sides that are as long as each other to rounding, the first.
            if (glm::length(edge) > 1.0001 * glm::length(shape.edge)) shape.edge = edge;
        }
    });
}

std::optional<LampAxes> axes_of(const LampShape& shape, Vec3 up) {
    const auto normal = shape.normal();
    if (!normal) return std::nullopt;
    const glm::dvec3 n(*normal);
    const glm::dvec3 along = shape.edge - glm::dot(shape.edge, n) * n;
    if (!(glm::length(along) > 1e-3 * glm::length(shape.edge))) return std::nullopt;
    Vec3 width(glm::normalize(along)), height = glm::cross(*normal, width);
    const auto rise = [&](Vec3 v) { return std::abs(glm::dot(v, glm::normalize(up))); };
    constexpr float kLevel = 1e-3f;
    const bool level = rise(width) < kLevel && rise(height) < kLevel;
    if (level ? std::abs(height.x) > std::abs(width.x) + kLevel : rise(width) > rise(height))
        std::swap(width, height);
    return LampAxes{width, height, *normal};
}

void add_extent(const Mesh& mesh, const Mat4& to_world, std::span<const Material> materials,
                Vec3 along, float& low, float& high) {
    for_each_emitting(mesh, materials, [&](std::uint32_t p, const Material&) {
        for_each_triangle(mesh, p, [&](Vec3 a, Vec3 b, Vec3 c) {
            for (const Vec3 corner : {a, b, c}) {
                const float at = glm::dot(along, Vec3(to_world * Vec4(corner, 1)));
                low = std::min(low, at);
                high = std::max(high, at);
            }
        });
    });
}

}  // namespace chiaro
