// Points on surfaces: from (object, primitive, u, v) to place, normals, texture and reflectance.
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <cmath>

namespace chiaro {

/// `v` at unit length, whatever its length; `otherwise` if it has none.
inline Vec3 safe_normalize(Vec3 v, Vec3 otherwise) {
    const float squared = glm::dot(v, v);
    if (squared > 1e-30f && squared < 1e30f) return v * (1.0f / std::sqrt(squared));
    // The squares are not to be trusted, as of a small triangle's normal: scaled first.
    const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0)) return otherwise;
    const Vec3 scaled = v / largest;
    return scaled * (1.0f / std::sqrt(glm::dot(scaled, scaled)));
}

/// A place on a surface. A bicubic patch has (u, v) of its own; a quad is mapped as Embree maps it:
/// u + v <= 1 lies in triangle (0, 1, 3) at p0 + u (p1 - p0) + v (p3 - p0), the rest in (2, 3, 1).
/// A triangle: u, v are the barycentric weights of corners 1 and 2.
struct SurfacePoint {
    ObjectId object = ObjectId::none;
    std::uint32_t primitive = 0;  // in the object's mesh
    float u = 0;                  // [0, 1]
    float v = 0;
};

/// Corners (indices 0 to 3 of the primitive) and weights (sum 1) that (u, v) blends.
struct CornerWeights {
    std::array<std::uint8_t, 3> corners;
    std::array<float, 3> weights;
};
CornerWeights corner_weights(bool is_quad, float u, float v);

/// Cross product, in object space, of two edges of the triangle that `w` blends, along the front
/// side's normal. One half of a quad may have no area; the other then speaks for both.
/// Not of bicubic patches.
Vec3 front_cross(const Mesh& mesh, const Primitive& primitive, const CornerWeights& w);

/// Geometry at a surface point, in world space. Normals are of unit length, on the front side
/// (counter-clockwise winding); `shading_normal` is interpolated where the mesh has normals and is
/// on the same side as `geometric_normal`.
struct SurfaceGeometry {
    Vec3 position;
    Vec3 geometric_normal;
    Vec3 shading_normal;
    const Primitive* primitive;  // in the scene, valid while it is
    const Material* material;
};
SurfaceGeometry surface_geometry(const Scene& scene, const SurfacePoint& point);

/// How the position changes with u and with v there (world space).
struct SurfaceTangents {
    Vec3 u, v;
};
SurfaceTangents surface_tangents(const Scene& scene, const SurfacePoint& point);

/// The position alone (world space).
Vec3 surface_position(const Scene& scene, const SurfacePoint& point);

/// The shading normal alone, for a caller that has the geometric one (both world space, unit,
/// front).
Vec3 shading_normal(const Scene& scene, const SurfacePoint& point, Vec3 geometric_normal);

/// Takes a cross product of edges in object space to that of the same edges in world space, on the
/// front side also where the transform mirrors; normals keep their direction but not their length.
Mat3 normal_matrix(const Mat4& to_world);

/// The material of the primitive that the point lies on.
MaterialId material_of(const Scene& scene, const SurfacePoint& point);

/// Diffuse reflectance at the point in [0, 1] a channel (base colour x texture x vertex colour) and
/// its alpha in [0, 1].
Vec4 base_color(const Scene& scene, const SurfacePoint& point);

/// The part of what meets the surface at the point that it stops, in [0, 1]: all where it is
/// opaque, all or nothing where it is masked, its alpha where it is blended.
float opacity(const Scene& scene, const SurfacePoint& point);

/// Metallic and roughness at the point, in this order, each factor x texture (glTF); linear.
Vec2 metallic_roughness(const Scene& scene, const SurfacePoint& point);

/// Mean of base_color() over a material's texture, vertex colours aside.
Rgb mean_reflectance(const Scene& scene, const Material& material);

/// Exitant radiance by emission from the point's front (`front`) or back face [cd/m2 a channel]; as
/// its object scales it.
Rgb emission(const Scene& scene, const SurfacePoint& point, bool front);

/// Mean of emission() over a material's texture, not 0 if any of it shines; what an object scales
/// it by aside.
Rgb mean_emission(const Scene& scene, const Material& material);

/// Area in world space of a primitive [scene units squared].
float primitive_area(const Scene& scene, ObjectId object, std::uint32_t primitive);

}  // namespace chiaro
