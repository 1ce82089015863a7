#include "sample_renderer/next_event.h"

#include "sample_renderer/warp.h"

#include <cmath>

namespace chiaro {
namespace {

std::optional<LightConnection> over(std::optional<LightConnection> connection, float probability) {
    if (connection) connection->irradiance /= probability;
    return connection;
}

float sun_brings(const LitScene& lit, const Receiver& receiver, std::uint32_t sun) {
    const PunctualLight& light = lit.scene.lights[sun];
    return max_component(light.intensity) * receiving_cosine(receiver, -light.direction);
}

// What all suns would bring. As of the lamps, some choices are even: a brighter sun may be hidden.
struct SunLight {
    float sum = 0;
    float shining = 0;  // how many bring any

    float chance(float brings) const {
        constexpr float kEven = PunctualLights::kEvenPart;
        return kEven / shining + (1 - kEven) * brings / sum;
    }
};

SunLight sun_light(const LitScene& lit, const Receiver& receiver) {
    SunLight all;
    for (const std::uint32_t sun : lit.punctual.suns()) {
        const float brings = sun_brings(lit, receiver, sun);
        all.sum += brings;
        if (brings > 0) ++all.shining;
    }
    return all;
}

}  // namespace

LitScene make_lit_scene(const Scene& scene, const RayCaster& caster,
                        const AreaLights& area_lights) {
    return {scene, caster, area_lights, PunctualLights(scene), EnvironmentLight(scene)};
}

Receiver make_receiver(const RayCaster& caster, ObjectId object, Vec3 position,
                       Vec3 geometric_normal, Vec3 shading_normal) {
    const float lift = caster.offset(position, object);
    return {position, position + lift * geometric_normal, geometric_normal, shading_normal};
}

Vec3 sample_receiving_cosine(const Receiver& receiver, Vec2 u) {
    const Vec3 w = Frame(receiver.shading_normal).to_world(square_to_cosine_hemisphere(u));
    return glm::dot(receiver.geometric_normal, w) > 0 ? w : mirrored(receiver, w);
}

float pdf_receiving_cosine(const Receiver& receiver, Vec3 w) {
    return receiving_cosine(receiver, w) * (1 / kPi);
}

std::optional<AreaLightView> view_area_light(const LitScene& lit, const Receiver& receiver,
                                             float choice, Vec2 spot) {
    // One variable for every return: a copy would cost as much as the rest.
    std::optional<AreaLightView> result;
    const auto chosen = lit.area_lights.sample(lit_place(receiver), choice, spot);
    if (!chosen) return result;
    const AreaLightSample& sample = *chosen;
    const Vec3 between = sample.position - receiver.position;
    const float squared = glm::dot(between, between);
    if (!(squared > 0)) return result;
    const Vec3 to_light = between * (1.0f / std::sqrt(squared));
    const float light_cosine = -glm::dot(sample.normal, to_light);
    const float cosine = receiving_cosine(receiver, to_light);
    if (light_cosine == 0 || !(cosine > 0)) return result;
    const Rgb radiance = lit.area_lights.eval(sample, -to_light);
    if (radiance == Rgb(0)) return result;

    // The shadow ray ends as far off the light as it starts off the receiver.
    const float lift = lit.caster.offset(sample.position, sample.point.object);
    const Vec3 end = sample.position + std::copysign(lift, light_cosine) * sample.normal;
    const Ray shadow_ray = {receiver.origin, end - receiver.origin, 0, 1};
    result = {sample, to_light, squared, cosine, std::abs(light_cosine), radiance, shadow_ray};
    return result;
}

std::optional<LightConnection> connect_area_light(const LitScene& lit, const Receiver& receiver,
                                                  float choice, Vec2 spot) {
    const auto view = view_area_light(lit, receiver, choice, spot);
    if (!view) return std::nullopt;
    LightConnection connection;
    connection.shadow_ray = view->shadow_ray;
    connection.pdf_solid_angle = view->sample.pdf_area * view->squared / view->light_cosine;
    connection.to_light = view->to_light;
    connection.cosine = view->cosine;
    connection.irradiance = view->radiance * (connection.cosine / connection.pdf_solid_angle);
    return connection;
}

std::optional<LightConnection> connect_punctual(const LitScene& lit, const Receiver& receiver,
                                                std::uint32_t index) {
    const PunctualLight& light = lit.scene.lights[index];
    const std::optional<PunctualArrival> found = arrival(light, receiver.position);
    if (!found || found->irradiance == Rgb(0)) return std::nullopt;
    const float cosine = receiving_cosine(receiver, found->to_light);
    if (cosine <= 0) return std::nullopt;

    LightConnection connection;
    connection.to_light = found->to_light;
    connection.cosine = cosine;
    connection.irradiance = found->irradiance * cosine;
    connection.shadow_ray = light.kind == LightKind::directional
                                ? Ray{receiver.origin, found->to_light}
                                : ray_to_lamp(receiver.origin, light.position);
    return connection;
}

std::optional<LightConnection> connect_lamp(const LitScene& lit, const Receiver& receiver,
                                            float choice) {
    const auto chosen = lit.punctual.sample_lamp(lit_place(receiver), choice);
    if (!chosen) return std::nullopt;
    return over(connect_punctual(lit, receiver, chosen->light), chosen->probability);
}

std::optional<LightChoice> choose_sun(const LitScene& lit, const Receiver& receiver, float choice) {
    const std::span<const std::uint32_t> suns = lit.punctual.suns();
    const SunLight all = sun_light(lit, receiver);
    if (!(all.sum > 0)) return std::nullopt;
    LightChoice chosen = {};
    float before = 0;
    for (const std::uint32_t sun : suns) {
        if (before > choice) break;
        const float brings = sun_brings(lit, receiver, sun);
        if (!(brings > 0)) continue;
        chosen = {sun, all.chance(brings)};
        before += chosen.probability;
    }
    return chosen;
}

float sun_chance(const LitScene& lit, const Receiver& receiver, std::uint32_t sun) {
    const float brings = sun_brings(lit, receiver, sun);
    return brings > 0 ? sun_light(lit, receiver).chance(brings) : 0.0f;
}

std::optional<LightConnection> connect_sun(const LitScene& lit, const Receiver& receiver,
                                           float choice) {
    const std::span<const std::uint32_t> suns = lit.punctual.suns();
    if (suns.size() == 1) return connect_punctual(lit, receiver, suns[0]);
    const auto chosen = choose_sun(lit, receiver, choice);
    if (!chosen) return std::nullopt;
    return over(connect_punctual(lit, receiver, chosen->light), chosen->probability);
}

std::optional<LightConnection> connect_environment(const LitScene& lit, const Receiver& receiver,
                                                   Vec2 place) {
    const auto sample = lit.environment.sample(lit_place(receiver), place);
    if (!sample || sample->radiance == Rgb(0)) return std::nullopt;
    const float cosine = receiving_cosine(receiver, sample->direction);
    if (cosine <= 0) return std::nullopt;

    LightConnection connection;
    connection.shadow_ray = {receiver.origin, sample->direction};
    connection.to_light = sample->direction;
    connection.irradiance = sample->radiance * (cosine / sample->pdf);
    connection.cosine = cosine;
    connection.pdf_solid_angle = sample->pdf;
    return connection;
}

float pdf_area_light(const LitScene& lit, const LitPlace& from, Vec3 direction, const Hit& hit) {
    const float cosine = std::abs(glm::dot(hit.normal, direction));
    if (!(cosine > 0)) return 0;
    const float pdf_area = lit.area_lights.pdf(from, hit.point.object, hit.point.primitive);
    return pdf_area * hit.t * hit.t / cosine;
}

}  // namespace chiaro
