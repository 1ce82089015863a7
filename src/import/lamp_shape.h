// Area lights as an edit sees them: how large they are, where they face, how bright they are.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <span>

namespace chiaro {

/// A colour, not black, made as bright as white.
inline Rgb of_luminance_1(Rgb color) {
    return color / luminance(color);
}

/// Sums over the emitting primitives of objects (world space).
struct LampShape {
    glm::dvec3 vector_area = glm::dvec3(0);  // area times front normal
    double area = 0;
    glm::dvec3 emitted = glm::dvec3(0);  // mean radiance times area
    glm::dvec3 edge = glm::dvec3(0);     // the longest side of any of them

    /// Whether anything shines, be it by its texture alone.
    bool shines() const { return area > 0 && luminance(Rgb(emitted)) > 0; }
    /// The mean radiance [cd/m2 a channel] at an emission scale of 1; there is area.
    Rgb radiance() const { return Rgb(emitted / area); }
    /// Where it faces, unit; nothing if it shines all round.
    std::optional<Vec3> normal() const;
};

/// Adds a mesh in a place. `materials` are those of its primitives; textures are the scene's.
void add_lamp(const Mesh& mesh, const Mat4& to_world, std::span<const Material> materials,
              const Scene& scene, LampShape& shape);

/// The axes along which a lamp's width and height are measured, both unit and across its normal:
/// along and across its longest side, height being the one nearer to the vertical, or of two that
/// are level width the one nearer to x.
struct LampAxes {
    Vec3 width, height, normal;
};
std::optional<LampAxes> axes_of(const LampShape& shape, Vec3 up);

/// How long the emitting primitives are along a unit vector: least and largest coordinate are
/// added to `low` and `high`.
void add_extent(const Mesh& mesh, const Mat4& to_world, std::span<const Material> materials,
                Vec3 along, float& low, float& high);

}  // namespace chiaro
