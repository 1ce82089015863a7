#include "scene/light.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// The falloff between the cones that KHR_lights_punctual recommends: the square of a ramp in the
// cosine of the angle from the axis.
float spot_falloff(const PunctualLight& light, float cos_angle) {
    const float cos_inner = std::cos(light.inner_cone);
    const float cos_outer = std::cos(light.outer_cone);
    const float ramp = (cos_angle - cos_outer) / std::max(0.001f, cos_inner - cos_outer);
    const float clamped = std::clamp(ramp, 0.0f, 1.0f);
    return clamped * clamped;
}

}  // namespace

Rgb intensity_toward(const PunctualLight& light, Vec3 w) {
    if (!light.on) return Rgb(0);
    if (light.kind != LightKind::spot) return light.intensity;
    return light.intensity * spot_falloff(light, glm::dot(w, light.direction));
}

std::optional<PunctualArrival> arrival(const PunctualLight& light, Vec3 point) {
    if (!light.on) return std::nullopt;
    if (light.kind == LightKind::directional)
        return PunctualArrival{-light.direction, kInfinity, light.intensity};

    const Vec3 to_light = light.position - point;
    const float squared = glm::dot(to_light, to_light);
    if (!(squared > 0)) return std::nullopt;
    const float distance = std::sqrt(squared);
    PunctualArrival result{to_light / distance, distance, light.intensity / squared};
    if (light.kind == LightKind::spot) {
        const float falloff = spot_falloff(light, -glm::dot(result.to_light, light.direction));
        if (!(falloff > 0)) return std::nullopt;
        result.irradiance *= falloff;
    }
    return result;
}

}  // namespace chiaro
