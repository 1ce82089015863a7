// Which punctual light a point asks, where there are too many to ask each. Lamps and suns are
// chosen apart, and every kind of light is asked at every point: which of them gets there, no
// choice can know.
#pragma once

#include "scene/light_clusters.h"
#include "scene/scene.h"

#include <span>
#include <vector>

namespace chiaro {

/// A light chosen at random; `light` is its index in Scene::lights.
struct LightChoice {
    std::uint32_t light;
    float probability;  // > 0
};

/// The punctual lights of a scene that shine, by kind.
///
/// Thread: const calls from any number of threads. Describes the lights as they were when built, so
/// build anew when they change.
class PunctualLights {
public:
    explicit PunctualLights(const Scene& scene);

    /// Points and spots, whose light depends on the place; indices in Scene::lights.
    std::span<const std::uint32_t> lamps() const { return lamps_; }
    /// Directional lights; indices in Scene::lights.
    std::span<const std::uint32_t> suns() const { return suns_; }
    bool empty() const { return lamps_.empty() && suns_.empty(); }

    /// One of the lamps, by what each may bring to the place (scene/light_clusters.h), but none
    /// with less than kEvenPart of an even chance: a brighter one may be hidden. Nothing if none
    /// was found that shines there, which is worth nothing. `u` in [0, 1).
    std::optional<LightChoice> sample_lamp(const LitPlace& place, float u) const;

    /// The chance that sample_lamp() has of this lamp, an index in Scene::lights.
    float lamp_chance(const LitPlace& place, std::uint32_t light) const;

    /// Part of the choices that are even.
    static constexpr float kEvenPart = 0.1f;

private:
    float chance(float by_place) const;

    std::vector<std::uint32_t> lamps_, suns_;
    LightClusters clusters_;  // of the lamps, in their order
};

}  // namespace chiaro
