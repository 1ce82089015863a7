// The renderer `caustic`: `path`, and specular surfaces sampled from the shading point (the paper's
// section 7 and Figure 6). For rings, mirrors and glasses that focus light on what is near them.
#pragma once

#include "sample_renderer/shade_tasks.h"

namespace chiaro {

/// Direct light is PathRenderer's. Indirect light adds to each path one whose first ray is aimed at
/// a surface that focuses light (aimed_rays.h), and to every place on a path the lamps and suns
/// that flat mirrors show there (mirror_light.h). No light is counted twice. Lacks the light of
/// punctual lights that comes by way of smooth surfaces which are curved, refract, or are two in a
/// row.
///
/// Thread: as SampleRenderer. Keeps references as PathRenderer; build anew when specular surfaces
/// change or move.
class CausticRenderer : public SampleRenderer {
public:
    CausticRenderer(const Scene& scene, const RayCaster& caster, const AreaLights& area_lights,
                    const OpenSides* open_sides, int threads);
    void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) override;
    SampleCosts typical_costs() const override;

private:
    LitScene lit_;
    const OpenSides* open_sides_;
    int threads_;
    SampledSurfaces focusing_;
    std::vector<FlatMirror> mirrors_;  // what lit_ names
};

}  // namespace chiaro
