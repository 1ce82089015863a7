#include "sample_renderer/punctual_lights.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// A point shines in all directions; a spot's cone is taken as evenly lit.
LightBounds bounds_of(const PunctualLight& light) {
    LightBounds bounds;
    bounds.box.add(light.position);
    bounds.cone = kPi;
    if (light.kind == LightKind::spot) {
        bounds.axis = light.direction;
        bounds.cone = light.outer_cone;
        bounds.reach = 0;
    }
    bounds.intensity = choice_weight(light.intensity);
    return bounds;
}

}  // namespace

PunctualLights::PunctualLights(const Scene& scene) {
    std::vector<LightBounds> bounds;
    double sum = 0;
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        const PunctualLight& light = scene.lights[i];
        if (!light.lit()) continue;
        if (light.kind == LightKind::directional) {
            suns_.push_back(i);
            continue;
        }
        lamps_.push_back(i);
        bounds.push_back(bounds_of(light));
        sum += bounds.back().intensity;
    }
    // Clusters get shares, which no unit can make too large.
    for (LightBounds& b : bounds)
        b.intensity = std::max(static_cast<float>(b.intensity / sum), 1e-30f);
    clusters_ = LightClusters(bounds);
}

float PunctualLights::chance(float by_place) const {
    return kEvenPart / static_cast<float>(lamps_.size()) + (1 - kEvenPart) * by_place;
}

float PunctualLights::lamp_chance(const LitPlace& place, std::uint32_t light) const {
    if (lamps_.size() == 1) return 1;
    const auto found = std::lower_bound(lamps_.begin(), lamps_.end(), light);
    return chance(clusters_.pdf(place, static_cast<std::uint32_t>(found - lamps_.begin())));
}

std::optional<LightChoice> PunctualLights::sample_lamp(const LitPlace& place, float u) const {
    if (lamps_.empty()) return std::nullopt;
    if (lamps_.size() == 1) return LightChoice{lamps_[0], 1};
    const auto count = static_cast<float>(lamps_.size());
    if (u < kEvenPart) {
        const auto last = static_cast<std::uint32_t>(lamps_.size() - 1);
        const auto lamp = std::min(static_cast<std::uint32_t>(u / kEvenPart * count), last);
        return LightChoice{lamps_[lamp], chance(clusters_.pdf(place, lamp))};
    }
    const float rest = std::min((u - kEvenPart) / (1 - kEvenPart), 0x1.fffffep-1f);
    const auto found = clusters_.sample(place, rest);
    if (!found) return std::nullopt;
    return LightChoice{lamps_[found->light], chance(found->probability)};
}

}  // namespace chiaro
