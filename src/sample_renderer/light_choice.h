// Which light a path asks at each of its points: one of the punctual ones, or the area lights
// together, by power.
#pragma once

#include "scene/area_lights.h"

#include <vector>

namespace chiaro {

/// Discrete choice among the area lights as one and each punctual light, the same everywhere; which
/// area light is asked depends on the place (AreaLights::sample()).
///
/// Thread: const calls from any number of threads.
class LightChoice {
public:
    /// `cross_section`: area that the scene shows to a directional light, for its power.
    LightChoice(const Scene& scene, const AreaLights& area_lights, float cross_section);

    /// One choice; `punctual` is the light's index, or -1 for the area lights.
    struct Choice {
        int punctual;
        float probability;
        float rest;  // the number used, spread over [0, 1) again
    };

    bool empty() const { return cumulative_.empty(); }
    /// `u` in [0, 1). Checks: not empty().
    Choice sample(float u) const;
    /// Among the punctual lights alone. Checks: one of them shines.
    Choice sample_punctual(float u) const;
    /// Probability with which sample() gives the area lights.
    float probability_of_area_lights() const { return empty() ? 0.0f : cumulative_[0]; }
    bool any_punctual() const { return probability_of_area_lights() < 1 && !empty(); }

private:
    std::vector<float> cumulative_;  // the area lights, then each punctual light; empty: no light
};

/// Area of the largest disk through the box that holds the scene.
float cross_section(const Scene& scene);

}  // namespace chiaro
