// Surfaces that points are drawn from, to be asked what light comes from there.
#pragma once

#include "base/weighted_choice.h"
#include "scene/light_clusters.h"
#include "scene/surface.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace chiaro {

/// A point on one of the surfaces.
struct SurfaceSample {
    SurfacePoint point;
    Vec3 position;          // world
    Vec3 normal;            // geometric, of the front face; world, unit
    std::uint32_t surface;  // in the order of SampledSurfaces
    float pdf_area;         // over area, the choice included [1 / scene units squared]
};

/// What a surface counts for, an area; 0: it is left out.
struct SurfaceWeight {
    float weight = 0;
    bool two_sided = true;  // light comes from their backs too
};

/// Primitives of a scene in world space, chosen by what they may bring to a place
/// (scene/light_clusters.h), then uniformly by area, or nearly so on bicubic patches.
///
/// Thread: const calls from any number of threads. Describes the scene as it was when built, so
/// build anew when places or weights change.
class SampledSurfaces {
public:
    /// Of all materials, by index.
    SampledSurfaces(const Scene& scene, std::span<const SurfaceWeight> of_material);
    using WeightOf = std::function<SurfaceWeight(ObjectId object, std::uint32_t primitive)>;
    SampledSurfaces(const Scene& scene, const WeightOf& weight_of);

    bool empty() const { return surfaces_.empty(); }
    std::size_t size() const { return surfaces_.size(); }
    /// Sum over all of weight x area x sides.
    double total_weight() const { return total_weight_; }
    /// The primitive that a surface is, at its (u, v) = (0, 0).
    const SurfacePoint& where(std::uint32_t surface) const { return surfaces_[surface].where; }

    /// Maps `choice` and `spot`, uniform in [0, 1), to a point of a surface from which light may
    /// come to `place`; nothing if none was found, which is worth nothing. Checks: not empty().
    std::optional<SurfaceSample> sample(const LitPlace& place, float choice, Vec2 spot) const;

    /// Density over area with which sample() gives this point; 0 if it is on none of the surfaces,
    /// or light never comes from it to `place`.
    float pdf(const LitPlace& place, const SurfacePoint& point) const;

    /// As sample() and pdf(), whatever the place: chosen by weight x area x sides.
    SurfaceSample sample_by_weight(float choice, Vec2 spot) const;
    float pdf_by_weight(const SurfacePoint& point) const;

private:
    struct Surface {
        SurfacePoint where;
        bool quad = false;
        Vec3 corners[4];
        Vec3 normals[2];       // of the halves; a triangle has one
        float first_half = 1;  // share of the area in the half (0, 1, 3)
        float inverse_area = 0;
        bool parallelogram = false;  // (u, v) itself is uniform in area
        std::uint32_t curve = kFlat;
    };
    static constexpr std::uint32_t kFlat = 0xffff'ffff;

    // A bicubic patch in world space, in cells even in (u, v) that are chosen by their area.
    struct Curve {
        static constexpr std::uint32_t kAcross = 8;
        BicubicPatch patch;
        bool mirrored;  // its front is where du x dv does not point
        WeightedChoice cells;
    };

    Surface make_surface(const Scene& scene, const SurfacePoint& where, float area);
    std::uint32_t add_curve(const BicubicPatch& patch, const Mat4& to_world);
    float density_on(std::uint32_t surface, const SurfacePoint& point) const;
    LightBounds bounds_of(const Surface& surface, bool two_sided, float intensity) const;
    std::optional<std::uint32_t> surface_at(ObjectId object, std::uint32_t primitive) const;
    void place_on(std::uint32_t surface, float probability, Vec2 spot, SurfaceSample& result) const;
    static void place_on(const Surface& surface, Vec2 spot, SurfaceSample& result);
    static void place_on(const Curve& curve, Vec2 spot, SurfaceSample& result);
    std::vector<LightBounds> add_object(const Scene& scene, ObjectId object,
                                        const WeightOf& weight_of);

    double total_weight_ = 0;
    std::vector<Surface> surfaces_;
    std::vector<Curve> curves_;
    LightClusters clusters_;
    WeightedChoice by_weight_;
    std::vector<std::vector<std::uint32_t>>
        surface_of_;  // by object, by primitive; empty: none of the object's
};

}  // namespace chiaro
