// Emissive surfaces as lights that can be sampled: every primitive that emits.
#pragma once

#include "scene/sampled_surfaces.h"

namespace chiaro {

/// A point on an area light; `surface` is the light.
using AreaLightSample = SurfaceSample;

/// All emissive primitives of the objects that are shown, weighted by their luminance.
///
/// Thread: as SampledSurfaces. Keeps a reference to the scene; build anew when emitters, their
/// places or their textures change.
class AreaLights {
public:
    explicit AreaLights(const Scene& scene);

    bool empty() const { return surfaces_.empty(); }
    std::size_t size() const { return surfaces_.size(); }

    /// Luminous power of all together [lumen, when lengths are metres].
    float power() const { return static_cast<float>(double(kPi) * surfaces_.total_weight()); }

    /// Radiance that leaves `sample` along the unit vector `direction` [cd/m2 a channel], times the
    /// part of it that a transport ray would not pass through (alpha of a masked or blended
    /// emitter).
    Rgb eval(const AreaLightSample& sample, Vec3 direction) const {
        const bool front = glm::dot(sample.normal, direction) > 0;
        const PlainRadiance& light = plain_[sample.surface];
        return light.plain ? light.radiance[front] : varied_radiance(sample, front);
    }

    /// As SampledSurfaces has them.
    std::optional<AreaLightSample> sample(const LitPlace& place, float choice, Vec2 spot) const {
        return surfaces_.sample(place, choice, spot);
    }
    float pdf(const LitPlace& place, const SurfacePoint& point) const {
        return surfaces_.pdf(place, point);
    }

    /// Where walks from the lights start: chosen by power.
    AreaLightSample sample_by_power(float choice, Vec2 spot) const {
        return surfaces_.sample_by_weight(choice, spot);
    }
    float pdf_by_power(const SurfacePoint& point) const { return surfaces_.pdf_by_weight(point); }

private:
    // Of a light whose radiance does not vary, and that nothing shines through.
    struct PlainRadiance {
        bool plain = false;
        Rgb radiance[2] = {};  // of the back, of the front
    };

    Rgb varied_radiance(const AreaLightSample& sample, bool front) const;

    const Scene* scene_;
    SampledSurfaces surfaces_;
    std::vector<PlainRadiance> plain_;  // by light
};

}  // namespace chiaro
