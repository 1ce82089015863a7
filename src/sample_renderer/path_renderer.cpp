#include "sample_renderer/path_renderer.h"

namespace chiaro {

PathRenderer::PathRenderer(const Scene& scene, const RayCaster& caster,
                           const AreaLights& area_lights, const OpenSides* open_sides, int threads)
    : lit_(make_lit_scene(scene, caster, area_lights)),
      open_sides_(open_sides),
      threads_(threads) {}

SampleCosts PathRenderer::typical_costs() const {
    return {.direct = 0.12e-6f, .indirect = 0.9e-6f};
}

void PathRenderer::shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) {
    shade_requests(lit_, open_sides_, threads_, requests, results,
                   [&](const SampleRun& run, const Task&, PathWave& scratch) {
                       TaskResult result;
                       result.rays = add_indirect_samples(lit_, {&run, 1}, scratch, result.sums,
                                                          {.open_sides = open_sides_});
                       return result;
                   });
}

}  // namespace chiaro
