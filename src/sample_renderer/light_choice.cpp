#include "sample_renderer/light_choice.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

float power_of(const PunctualLight& light, float cross_section) {
    const float brightness = luminance(light.intensity) + 1e-6f * max_component(light.intensity);
    switch (light.kind) {
        case LightKind::point:
            return 4 * kPi * brightness;
        case LightKind::spot: {
            // The smooth edge counts by half.
            const float edge = 0.5f * (std::cos(light.inner_cone) + std::cos(light.outer_cone));
            return 2 * kPi * std::max(1e-4f, 1 - edge) * brightness;
        }
        case LightKind::directional:
            return cross_section * brightness;
    }
    return 0;
}

}  // namespace

float cross_section(const Scene& scene) {
    const float radius = 0.5f * bounds(scene).diagonal();
    return kPi * radius * radius;
}

LightChoice::LightChoice(const Scene& scene, const AreaLights& area_lights, float cross_section) {
    double sum = area_lights.power();
    cumulative_.push_back(area_lights.power());
    for (const PunctualLight& light : scene.lights) {
        sum += power_of(light, cross_section);
        cumulative_.push_back(static_cast<float>(sum));
    }
    for (float& entry : cumulative_) entry = static_cast<float>(entry / sum);
    if (!(sum > 0)) cumulative_.clear();
}

LightChoice::Choice LightChoice::sample(float u) const {
    check(!cumulative_.empty(), "LightChoice: no light to choose");
    if (cumulative_[0] == 1) return {-1, 1, u};
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
    const auto index = static_cast<int>(
        std::min<std::ptrdiff_t>(found - cumulative_.begin(), std::ssize(cumulative_) - 1));
    const float before = index == 0 ? 0.0f : cumulative_[index - 1];
    const float probability = cumulative_[index] - before;
    const float rest = probability > 0 ? (u - before) / probability : 0.0f;
    return {index - 1, probability, std::clamp(rest, 0.0f, 0x1.fffffep-1f)};
}

LightChoice::Choice LightChoice::sample_punctual(float u) const {
    check(any_punctual(), "LightChoice: no punctual light");
    const float area = cumulative_[0];
    Choice choice = sample(std::min(area + u * (1 - area), 0x1.fffffep-1f));
    choice.probability /= 1 - area;
    return choice;
}

}  // namespace chiaro
