// The renderer `bidirectional`: walks from the point and from lights that are joined. Ahead of
// `path` where light comes from what a point does not see, as from a lamp behind a screen or a
// caustic.
#pragma once

#include "sample_renderer/emitters.h"
#include "sample_renderer/sample_renderer.h"
#include "scene/open_sides.h"

namespace chiaro {

/// Agrees with PathRenderer, and finds more of punctual lights: all but what reaches the shading
/// point straight from a smooth surface. Direct light is computed alike.
///
/// Thread, references and Light::total: as of PathRenderer. Build anew when a light changes, or the
/// bounds of a scene with suns.
class BidirectionalRenderer : public SampleRenderer {
public:
    BidirectionalRenderer(const Scene& scene, const RayCaster& caster,
                          const AreaLights& area_lights, const OpenSides* open_sides, int threads);
    void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) override;
    SampleCosts typical_costs() const override;

private:
    LitScene lit_;
    Emitters emitters_;
    const OpenSides* open_sides_;
    int threads_;
};

}  // namespace chiaro
