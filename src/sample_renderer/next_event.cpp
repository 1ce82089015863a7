#include "sample_renderer/next_event.h"

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

LightConnections8 connect_area_light(const LitScene& lit, const Receiver8& receivers, Float8 choice,
                                     const Vec2x8& spot, unsigned lanes) {
    const Lanes3 places(receivers.position), origins(receivers.origin),
        normals(receivers.geometric_normal), numbers({choice, spot.x, spot.y});
    Lanes3 positions, light_normals, radiances;
    alignas(32) float pdf_area[kLanes] = {}, lifts[kLanes] = {};
    for_each_lane(lanes, [&](int i) {
        const Vec3 number = numbers.lane(i);
        const auto sample = lit.area_lights.sample({origins.lane(i), normals.lane(i)}, number.x,
                                                   {number.y, number.z});
        if (!sample) return;
        positions.set(i, sample->position);
        light_normals.set(i, sample->normal);
        radiances.set(i, lit.area_lights.eval(*sample, places.lane(i) - sample->position));
        pdf_area[i] = sample->pdf_area;
        lifts[i] = lit.caster.offset(sample->position, sample->point.object);
    });

    const Float8 zero(0);
    const Vec3x8 position = positions.all(), normal = light_normals.all();
    const Vec3x8 between = position - receivers.position;
    const Float8 squared = dot(between, between);
    const Vec3x8 to_light = (Float8(1) / sqrt(squared)) * between;
    const Float8 signed_light_cosine = zero - dot(normal, to_light);
    const Float8 light_cosine = abs(signed_light_cosine);
    const Vec3x8 end = position + copysign(load8(lifts), signed_light_cosine) * normal;

    LightConnections8 c;
    c.shadow_direction = end - receivers.origin;
    c.cosine = receiving_cosine(receivers, to_light);
    c.pdf_solid_angle = load8(pdf_area) * squared / light_cosine;
    c.irradiance = (c.cosine / c.pdf_solid_angle) * radiances.all();
    c.found = lanes & ((squared > zero) & (light_cosine > zero) & (c.cosine > zero) &
                       (max_component(radiances.all()) > zero))
                          .lanes();
    return c;
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
    const float pdf_area = lit.area_lights.pdf(from, hit.point);
    return pdf_area * hit.t * hit.t / cosine;
}

}  // namespace chiaro
