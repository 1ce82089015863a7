// The renderer `gather`: one ray a sample, ended by the irradiance that a cell of the surface it
// meets is known to receive (irradiance/irradiance_cells.h). The default: its noise is a fraction
// of a traced path's, at a small bias (docs/results.md), and `path` tells the truth beside it.
#pragma once

#include "sample_renderer/bright_surfaces.h"
#include "sample_renderer/cell_filling.h"
#include "sample_renderer/sample_renderer.h"
#include "scene/open_sides.h"

namespace chiaro {

/// Direct light is PathRenderer's. Of indirect light, rays that meet a surface too near for a cell,
/// or where neither their cell is known nor the one twice as long, are traced on.
///
/// Cells are filled once enough rays have asked for them, from the places that these rays met, and
/// filled further in proportion to what ends in them. Reads see them as they stood before the
/// batch; what a batch of rays asks for is done after it, in the order of requests. So the same
/// calls of shade(), one after the other, give the same bits on any number of threads; but a
/// request's result depends on what was asked before it.
///
/// Cells know the scene as it is: after an edit, make another renderer.
///
/// Thread: as SampleRenderer. Keeps references, as PathRenderer does; of lights it keeps copies.
class GatherRenderer : public SampleRenderer {
public:
    GatherRenderer(const Scene& scene, const RayCaster& caster, const AreaLights& area_lights,
                   const OpenSides* open_sides, int threads, std::uint32_t seed = 0);
    void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) override;
    SampleCosts typical_costs() const override;
    bool remembers() const override { return true; }

    const IrradianceCells& cells() const { return cells_; }

private:
    LitScene lit_;
    const OpenSides* open_sides_;
    int threads_;
    std::uint32_t seed_;
    SampledSurfaces bright_;
    IrradianceCells cells_;
    std::vector<std::vector<Asking>> asked_;  // by task of the batch
    std::vector<Asking> asking_;
};

}  // namespace chiaro
