#include "sample_renderer/join.h"

#include <cmath>

namespace chiaro {
namespace {

// Takes densities over solid angle along `direction` to those over area at the place.
float foreshortening(const Receiver& place, Vec3 direction, float squared) {
    return std::abs(glm::dot(place.geometric_normal, direction)) / squared;
}

}  // namespace

std::optional<Join> join(const PathVertex& eye, const PathVertex& light) {
    const Vec3 between = light.place.position - eye.place.position;
    const float squared = glm::dot(between, between);
    if (!(squared > 0)) return std::nullopt;
    const Vec3 to_light = between * (1 / std::sqrt(squared));
    const Toward from_eye = toward(eye, to_light);
    if (!(max_component(from_eye.carried) > 0)) return std::nullopt;
    const Toward from_light = toward(light, -to_light);
    Join found;
    found.value =
        eye.throughput * from_eye.carried * light.throughput * from_light.carried * (1 / squared);
    if (!(max_component(found.value) > 0)) return std::nullopt;

    // Each walk might have found the other's end.
    const float at_eye = from_light.pdf * foreshortening(eye.place, to_light, squared);
    const float at_light = from_eye.pdf * foreshortening(light.place, to_light, squared);
    found.weight = mis_weight(shorter_ways(light.trail, at_light, from_light.pdf_back),
                              shorter_ways(eye.trail, at_eye, from_eye.pdf_back));
    const Vec3 start = origin_toward(eye.place, to_light);
    found.shadow_ray = {start, origin_toward(light.place, -to_light) - start, 0, 1};
    return found;
}

std::optional<Join> join(const PathVertex& eye, const Receiver& place, const LightSample& light) {
    const Toward there = toward(eye, light.to_light);
    Join found;
    found.value = eye.throughput * there.carried * light.irradiance;
    if (!(max_component(found.value) > 0)) return std::nullopt;
    const float at_eye = light.start * light.direction * foreshortening(place, light.to_light, 1);
    found.weight = mis_weight(heuristic(there.pdf * light.met),
                              shorter_ways(eye.trail, at_eye, there.pdf_back));
    found.shadow_ray = light.shadow_ray;
    return found;
}

float weight_of_met_light(const Trail& trail, const MetLight& light) {
    return mis_weight(0, shorter_ways(trail, light.end, light.pdf_back));
}

}  // namespace chiaro
