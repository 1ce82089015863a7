#include "sample_renderer/emitters.h"

#include "sample_renderer/warp.h"

#include <cmath>

namespace chiaro {
namespace {

constexpr float kEvenPart = 0.1f;  // of the choices of a kind: the brightest may be hidden

// Cosine of the rim of what a lamp lights.
float rim_of(const PunctualLight& light) {
    constexpr float kWidestNeedle = 1 - 1e-6f;
    return light.kind == LightKind::spot ? std::min(std::cos(light.outer_cone), kWidestNeedle)
                                         : -1.0f;
}

bool shines_both_ways(const Scene& scene, ObjectId object, std::uint32_t primitive) {
    return scene.material(material_of(scene, {object, primitive})).emits_backward;
}

// Density over solid angle of directions from an area light; `cosine` is above 0.
float area_direction_density(float cosine, bool both_ways) {
    return pdf_cosine_hemisphere(cosine) * (both_ways ? 0.5f : 1.0f);
}

double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}

}  // namespace

Emitters::Emitters(const LitScene& lit) {
    const Scene& scene = lit.scene;
    const Box box = bounds(scene);
    if (!box.empty()) {
        centre_ = box.centre();
        radius_ = 0.5001f * box.diagonal();
    }

    // Powers by kind; a punctual light's place in its choice is its index in Scene::lights.
    std::vector<double> lamps(scene.lights.size(), 0.0), suns(scene.lights.size(), 0.0);
    for (const std::uint32_t i : lit.punctual.lamps())
        lamps[i] = choice_weight(scene.lights[i].intensity) / pdf_cone(rim_of(scene.lights[i]));
    for (const std::uint32_t i : lit.punctual.suns())
        suns[i] = choice_weight(scene.lights[i].intensity) / disk_density();
    lamps_ = WeightedChoice(lamps);
    suns_ = WeightedChoice(suns);

    const float sky = lit.environment.empty() ? 0 : choice_weight(mean_radiance(scene.environment));
    std::vector<double> kinds = {lit.area_lights.power(), sum_of(lamps), sum_of(suns),
                                 double(4 * kPi) * sky / disk_density()};
    const double all = sum_of(kinds);
    for (double& power : kinds)
        if (power > 0) power = kEvenPart / 4 + (1 - kEvenPart) * power / all;
    kinds_ = WeightedChoice(kinds);
}

std::optional<Emission> Emitters::sample(const LitScene& lit, float choice, Vec2 place,
                                         Vec2 direction) const {
    const WeightedChoice::Choice kind = kinds_.choose(choice);
    std::optional<Emission> emission;
    switch (static_cast<LightSource>(kind.index)) {
        case LightSource::area:
            emission = from_area(lit, kind.rest, place, direction);
            break;
        case LightSource::lamp:
            emission = from_lamp(lit, kind.rest, direction);
            break;
        case LightSource::sun:
            emission = from_sun(lit, kind.rest, place);
            break;
        case LightSource::sky:
            emission = from_sky(lit, place, direction);
            break;
    }
    if (!emission) return emission;
    emission->start *= kind.probability;
    emission->flux /= kind.probability;
    return emission;
}

std::optional<Emission> Emitters::from_area(const LitScene& lit, float choice, Vec2 place,
                                            Vec2 direction) const {
    const AreaLightSample sample = lit.area_lights.sample_by_power(choice, place);
    const auto [object, primitive, u, v] = sample.point;
    const bool both_ways = shines_both_ways(lit.scene, object, primitive);
    const bool back = both_ways && direction.x < 0.5f;
    if (both_ways)
        direction.x = std::min(back ? 2 * direction.x : 2 * direction.x - 1, 0x1.fffffep-1f);
    const Vec3 normal = back ? -sample.normal : sample.normal;
    const Vec3 local = square_to_cosine_hemisphere(direction);
    const Vec3 w = Frame(normal).to_world(local);
    const Rgb radiance = lit.area_lights.eval(sample, w);
    if (radiance == Rgb(0)) return std::nullopt;

    Emission emission = {.start = sample.pdf_area,
                         .direction = area_direction_density(local.z, both_ways),
                         .position = sample.position,
                         .normal = normal,
                         .from = LightSource::area,
                         .object = object,
                         .index = primitive,
                         .uv = {sample.point.u, sample.point.v}};
    emission.ray = {sample.position + lit.caster.offset(sample.position, object) * normal, w};
    emission.flux = radiance * (local.z / (emission.start * emission.direction));
    return emission;
}

std::optional<Emission> Emitters::from_lamp(const LitScene& lit, float choice,
                                            Vec2 direction) const {
    const WeightedChoice::Choice chosen = lamps_.choose(choice);
    const PunctualLight& light = lit.scene.lights[chosen.index];
    const Vec3 axis = light.kind == LightKind::spot ? light.direction : Vec3(0, 0, 1);
    const Vec3 w = Frame(axis).to_world(square_to_cone(direction, rim_of(light)));
    const Rgb intensity = intensity_toward(light, w);
    if (intensity == Rgb(0)) return std::nullopt;
    // What the lamp stands in, as a ceiling, does not take its light.
    const float near = RayCaster::offset(light.position);
    Emission emission = {.ray = {light.position, w, near, kInfinity},
                         .start = chosen.probability,
                         .direction = pdf_cone(rim_of(light)),
                         .position = light.position,
                         .normal = Vec3(0),
                         .from = LightSource::lamp,
                         .index = chosen.index};
    emission.flux = intensity / (emission.start * emission.direction);
    return emission;
}

Ray Emitters::ray_from_infinity(Vec3 direction, Vec2 place) const {
    const Vec2 disk = radius_ * square_to_disk(place);
    return {centre_ + Frame(direction).to_world({disk.x, disk.y, -radius_}), direction};
}

Emission Emitters::from_sun(const LitScene& lit, float choice, Vec2 place) const {
    const WeightedChoice::Choice chosen = suns_.choose(choice);
    const PunctualLight& light = lit.scene.lights[chosen.index];
    Emission emission = {.ray = ray_from_infinity(light.direction, place),
                         .start = chosen.probability,
                         .direction = disk_density(),
                         .position = Vec3(0),
                         .normal = Vec3(0),
                         .from = LightSource::sun,
                         .index = chosen.index};
    emission.flux = light.intensity / (emission.start * emission.direction);
    return emission;
}

std::optional<Emission> Emitters::from_sky(const LitScene& lit, Vec2 place, Vec2 direction) const {
    const auto sample = lit.environment.sample_anywhere(direction);
    if (!sample || sample->radiance == Rgb(0)) return std::nullopt;
    Emission emission = {.ray = ray_from_infinity(-sample->direction, place),
                         .start = sample->pdf,
                         .direction = disk_density(),
                         .position = Vec3(0),
                         .normal = -sample->direction,
                         .from = LightSource::sky};
    emission.flux = sample->radiance / (emission.start * emission.direction);
    return emission;
}

float Emitters::chosen(const LitScene& lit, const Receiver& place, const Emission& emission) {
    switch (emission.from) {
        case LightSource::area:
            return lit.area_lights.pdf(
                lit_place(place), {emission.object, emission.index, emission.uv.x, emission.uv.y});
        case LightSource::lamp:
            return lit.punctual.lamp_chance(lit_place(place), emission.index);
        case LightSource::sun:
            return sun_chance(lit, place, emission.index);
        case LightSource::sky:
            break;
    }
    return lit.environment.pdf(lit_place(place), -emission.ray.direction);
}

std::optional<LightSample> Emitters::sample_area_light(const LitScene& lit, const Receiver& place,
                                                       const Numbers& numbers) const {
    const auto view = view_area_light(lit, place, numbers.choice, numbers.spot);
    if (!view) return std::nullopt;
    const AreaLightSample& sample = view->sample;
    const bool both_ways = shines_both_ways(lit.scene, sample.point.object, sample.point.primitive);
    const float walk = chance_of(LightSource::area) * lit.area_lights.pdf_by_power(sample.point);
    const float seen = view->light_cosine / view->squared;  // of the light's area, in solid angle
    return LightSample{
        .shadow_ray = view->shadow_ray,
        .to_light = view->to_light,
        .irradiance = view->radiance * (seen / sample.pdf_area),
        .start = walk / sample.pdf_area,
        .direction = area_direction_density(view->light_cosine, both_ways) / view->squared,
        .met = seen / sample.pdf_area};
}

std::optional<LightSample> Emitters::sample_lamp(const LitScene& lit, const Receiver& place,
                                                 float choice) const {
    const auto chosen = lit.punctual.sample_lamp(lit_place(place), choice);
    if (!chosen) return std::nullopt;
    const auto found = connect_punctual(lit, place, chosen->light);
    if (!found) return std::nullopt;
    const PunctualLight& light = lit.scene.lights[chosen->light];
    const Vec3 between = light.position - place.position;
    const float walk = chance_of(LightSource::lamp) * lamps_.probability(chosen->light);
    return LightSample{.shadow_ray = found->shadow_ray,
                       .to_light = found->to_light,
                       .irradiance = found->irradiance / (found->cosine * chosen->probability),
                       .start = walk / chosen->probability,
                       .direction = pdf_cone(rim_of(light)) / glm::dot(between, between)};
}

std::optional<LightSample> Emitters::sample_sun(const LitScene& lit, const Receiver& place,
                                                float choice) const {
    const auto chosen = choose_sun(lit, place, choice);
    if (!chosen) return std::nullopt;
    const auto found = connect_punctual(lit, place, chosen->light);
    if (!found) return std::nullopt;
    const float walk = chance_of(LightSource::sun) * suns_.probability(chosen->light);
    return LightSample{.shadow_ray = found->shadow_ray,
                       .to_light = found->to_light,
                       .irradiance = found->irradiance / (found->cosine * chosen->probability),
                       .start = walk / chosen->probability,
                       .direction = disk_density()};
}

std::optional<LightSample> Emitters::sample_sky(const LitScene& lit, const Receiver& place,
                                                Vec2 sky) const {
    const auto found = connect_environment(lit, place, sky);
    if (!found) return std::nullopt;
    const float walk = chance_of(LightSource::sky) * lit.environment.pdf_anywhere(found->to_light);
    return LightSample{.shadow_ray = found->shadow_ray,
                       .to_light = found->to_light,
                       .irradiance = found->irradiance / found->cosine,
                       .start = walk / found->pdf_solid_angle,
                       .direction = disk_density(),
                       .met = 1 / found->pdf_solid_angle};
}

MetLight Emitters::met(const LitScene& lit, const LitPlace& place, Vec3 direction,
                       const Hit& hit) const {
    const float cosine = std::abs(glm::dot(hit.normal, direction));
    const bool both_ways = shines_both_ways(lit.scene, hit.point.object, hit.point.primitive);
    return {{.walk = chance_of(LightSource::area) * lit.area_lights.pdf_by_power(hit.point),
             .chosen = lit.area_lights.pdf(place, hit.point)},
            area_direction_density(cosine, both_ways)};
}

MetLight Emitters::met_sky(const LitScene& lit, const LitPlace& place, Vec3 direction) const {
    return {{.walk = chance_of(LightSource::sky) * lit.environment.pdf_anywhere(direction),
             .chosen = lit.environment.pdf(place, direction)},
            disk_density()};
}

}  // namespace chiaro
