// The renderer `path`: next event estimation, multiple importance sampling, Russian roulette, no
// cap on bounces. The ground truth that other renderers are measured against.
#pragma once

#include "sample_renderer/shade_tasks.h"

namespace chiaro {

/// Irradiance is taken with the cosine about the shading normal, folded up where it reaches below
/// the real plane (receiver.h). Lacks the light of punctual lights by way of smooth surfaces,
/// which no path finds by chance.
///
/// Thread: as SampleRenderer. Keeps references: objects and materials may be edited between calls,
/// if the caster and the area lights are brought up to date with them; build anew when punctual
/// lights change. Where `open_sides` is null, nothing is buried. Of Light::total, `first_sample`
/// counts direct samples, and the indirect ones before it are taken to have been in the same
/// proportion.
class PathRenderer : public SampleRenderer {
public:
    PathRenderer(const Scene& scene, const RayCaster& caster, const AreaLights& area_lights,
                 const OpenSides* open_sides, int threads);
    void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) override;
    SampleCosts typical_costs() const override;

private:
    LitScene lit_;
    const OpenSides* open_sides_;
    int threads_;
};

}  // namespace chiaro
