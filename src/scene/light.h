// Lights without extent (KHR_lights_punctual). Area lights are emissive surfaces (material.h).
#pragma once

#include "base/color.h"

#include <optional>
#include <string>

namespace chiaro {

enum class LightKind { point, spot, directional };

struct PunctualLight {
    std::string name;
    LightKind kind = LightKind::point;
    Rgb intensity = Rgb(0);           // point, spot: candela a channel; directional: lux a channel
    Vec3 position = Vec3(0);          // world; unused when directional
    Vec3 direction = Vec3(0, 0, -1);  // world, unit, the way the light travels; unused when point
    float inner_cone = 0;             // spot: radians from the axis to full intensity
    float outer_cone = 0.785398163f;  // spot: radians from the axis to none
    float range = kInfinity;          // kept from the file; light is not cut off at it
    bool on = true;                   // false: nothing comes from it

    bool lit() const { return on && max_component(intensity) > 0; }
    bool operator==(const PunctualLight&) const = default;
};

/// Intensity that a point or spot sends along unit direction `w` [cd a channel]; black outside a
/// spot's cone and of a light that is off.
Rgb intensity_toward(const PunctualLight& light, Vec3 w);

/// Light that a punctual source would send to a point, were nothing in between.
struct PunctualArrival {
    Vec3 to_light;   // unit
    float distance;  // infinite when directional
    Rgb irradiance;  // on a surface facing the light [lux a channel]
};

/// What `light` sends to `point` (world); nothing outside a spot's cone, at the source itself or
/// of a light that is off.
/// Spot falloff as KHR_lights_punctual recommends: the square of a ramp in the cosine of the angle
/// from the axis, 1 at the inner cone and 0 at the outer.
std::optional<PunctualArrival> arrival(const PunctualLight& light, Vec3 point);

}  // namespace chiaro
