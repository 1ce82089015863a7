// Emissive surfaces as lights that can be sampled: every primitive whose material emits.
#pragma once

#include "scene/light_clusters.h"
#include "scene/surface.h"

#include <optional>
#include <span>
#include <vector>

namespace chiaro {

/// A point on an area light.
struct AreaLightSample {
    SurfacePoint point;
    Vec3 position;        // world
    Vec3 normal;          // geometric, of the front face; world, unit
    std::uint32_t light;  // in the order of AreaLights
    float pdf_area;       // over area, the choice included [1 / scene units squared]
};

/// All emissive primitives of a scene in world space, chosen by what they may bring to a place
/// (scene/light_clusters.h), then uniformly by area.
///
/// Thread: const calls from any number of threads. Keeps a reference to the scene; describes it as
/// it was when built, so build anew when emitters, their places or their textures change.
class AreaLights {
public:
    explicit AreaLights(const Scene& scene);

    bool empty() const { return lights_.empty(); }
    std::size_t size() const { return lights_.size(); }

    /// Luminous power of all together [lumen, when lengths are metres].
    float power() const { return power_; }

    /// Radiance that leaves `sample` along the unit vector `direction` [cd/m2 a channel], times the
    /// part of it that a transport ray would not pass through (alpha of a masked or blended
    /// emitter).
    Rgb eval(const AreaLightSample& sample, Vec3 direction) const;

    /// Maps `choice` and `spot`, uniform in [0, 1), to a point of a light that may shine on
    /// `place`; nothing if none was found, which is worth nothing. Checks: not empty().
    std::optional<AreaLightSample> sample(const LitPlace& place, float choice, Vec2 spot) const;

    /// Density over area with which sample() gives points of this primitive; 0 if it does not emit,
    /// or never toward `place`.
    float pdf(const LitPlace& place, ObjectId object, std::uint32_t primitive) const;

private:
    struct Light {
        SurfacePoint where;
        bool quad = false;
        Vec3 corners[4];
        Vec3 normals[2];       // of the halves; a triangle has one
        float first_half = 1;  // share of the area in the half (0, 1, 3)
        float inverse_area = 0;
        bool parallelogram = false;  // (u, v) itself is uniform in area
        bool plain = false;          // radiance does not vary, and nothing shines through
        Rgb radiance[2] = {};        // where plain: of the back, of the front
    };

    static Light make_light(const Scene& scene, const SurfacePoint& where, float area);
    static LightBounds bounds_of(const Light& light, bool two_sided, float intensity);
    static void place_on(const Light& light, Vec2 spot, AreaLightSample& result);
    std::vector<LightBounds> add_object(ObjectId object, const std::vector<float>& luminances);

    const Scene* scene_;
    float power_ = 0;
    std::vector<Light> lights_;
    LightClusters clusters_;
    std::vector<std::vector<std::uint32_t>>
        light_of_;  // by object, by primitive; empty: dark object
};

}  // namespace chiaro
