// Next event estimation: the light that one point gets from one point of a light, and the ray that
// tells whether anything is in between.
#pragma once

#include "rays/ray_caster.h"
#include "sample_renderer/flat_mirrors.h"
#include "sample_renderer/punctual_lights.h"
#include "sample_renderer/receiver.h"
#include "scene/area_lights.h"
#include "scene/environment_light.h"

namespace chiaro {

/// Russian roulette lets paths and walks survive with no more than this, or a closed room of albedo
/// 1 would never end.
inline constexpr float kMostSurvival = 0.98f;

/// All that light transport reads, a member for each kind of light; valid while what it names is.
struct LitScene {
    const Scene& scene;
    const RayCaster& caster;
    const AreaLights& area_lights;
    PunctualLights punctual;
    EnvironmentLight environment;
    std::span<const FlatMirror> mirrors = {};  // in which punctual lights are looked for

    /// True if nothing shines.
    bool dark() const { return area_lights.empty() && punctual.empty() && environment.empty(); }
};
/// Build anew when the scene's punctual lights or its environment change.
LitScene make_lit_scene(const Scene& scene, const RayCaster& caster, const AreaLights& area_lights);

/// A sample of the light at a receiver, before it is known whether it is blocked.
struct LightConnection {
    Ray shadow_ray;
    std::optional<Ray> second_ray;  // from a mirror on, where light comes by way of one
    Vec3 to_light;                  // unit
    Rgb irradiance;    // the sample's estimate: over the density with which it was chosen
    float cosine = 0;  // receiving_cosine() of the direction, which is in `irradiance`; > 0
    float pdf_solid_angle =
        0;  // of the direction, by light samples; 0: no other technique finds it

    /// Of the direction, by sampling the cosine at the receiver.
    float pdf_cosine() const { return cosine * (1 / kPi); }
};

/// A ray from a place to a lamp, not quite the whole way: the lamp may stand in a surface.
inline Ray ray_to_lamp(Vec3 from, Vec3 lamp) {
    return {from, lamp - from, 0, 1 - 1e-4f};
}

/// A point of an area light that may shine on a receiver, and the way there.
struct AreaLightView {
    AreaLightSample sample;
    Vec3 to_light;       // unit
    float squared;       // of the distance; > 0
    float cosine;        // receiving_cosine() of the direction; > 0
    float light_cosine;  // > 0
    Rgb radiance;        // toward the receiver; not black
    Ray shadow_ray;
};
/// `choice` and `spot` as AreaLights::sample() has them. Checks: there are area lights.
std::optional<AreaLightView> view_area_light(const LitScene& lit, const Receiver& receiver,
                                             float choice, Vec2 spot);

/// A point of the area lights; nothing if it cannot shine on the receiver. `choice` and `spot` as
/// AreaLights::sample() has them. Checks: there are area lights.
std::optional<LightConnection> connect_area_light(const LitScene& lit, const Receiver& receiver,
                                                  float choice, Vec2 spot);

/// The same for the receivers of `lanes`, a bit each; `found` tells of which there is something.
struct LightConnections8 {
    unsigned found;
    Vec3x8 shadow_direction;  // the ray starts at the receiver's origin and ends at 1
    Vec3x8 irradiance;
    Float8 cosine, pdf_solid_angle;

    Float8 pdf_cosine() const { return cosine * Float8(1 / kPi); }
};
LightConnections8 connect_area_light(const LitScene& lit, const Receiver8& receivers, Float8 choice,
                                     const Vec2x8& spot, unsigned lanes);

/// Punctual light `index`; nothing if it cannot shine on the receiver.
std::optional<LightConnection> connect_punctual(const LitScene& lit, const Receiver& receiver,
                                                std::uint32_t index);

/// One of the lamps for all (PunctualLights::sample_lamp()); nothing if that is worth nothing.
/// `choice` in [0, 1).
std::optional<LightConnection> connect_lamp(const LitScene& lit, const Receiver& receiver,
                                            float choice);

/// One of the suns, by the irradiance that each would bring; nothing if none can. `choice` in
/// [0, 1). And the chance that it has of a sun, which is an index in Scene::lights.
std::optional<LightChoice> choose_sun(const LitScene& lit, const Receiver& receiver, float choice);
float sun_chance(const LitScene& lit, const Receiver& receiver, std::uint32_t sun);

/// One of the suns for all, by the irradiance that each would bring; nothing if none can. `choice`
/// in [0, 1).
std::optional<LightConnection> connect_sun(const LitScene& lit, const Receiver& receiver,
                                           float choice);

/// A direction of the environment; nothing if that is worth nothing. `place` in [0, 1)^2. Checks:
/// the environment shines.
std::optional<LightConnection> connect_environment(const LitScene& lit, const Receiver& receiver,
                                                   Vec2 place);

/// Density over solid angle with which connect_area_light() takes `direction` at `from`, the
/// lit_place() of a receiver, where a ray of that unit direction met `hit`.
float pdf_area_light(const LitScene& lit, const LitPlace& from, Vec3 direction, const Hit& hit);

}  // namespace chiaro
