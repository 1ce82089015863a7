#include "sample_renderer/bidirectional_renderer.h"

#include "sample_renderer/bidirectional_light.h"
#include "sample_renderer/shade_tasks.h"

namespace chiaro {

BidirectionalRenderer::BidirectionalRenderer(const Scene& scene, const RayCaster& caster,
                                             const AreaLights& area_lights,
                                             const OpenSides* open_sides, int threads)
    : lit_(make_lit_scene(scene, caster, area_lights)),
      emitters_(lit_),
      open_sides_(open_sides),
      threads_(threads) {}

SampleCosts BidirectionalRenderer::typical_costs() const {
    return {.direct = 0.12e-6f, .indirect = 4e-6f};
}

void BidirectionalRenderer::shade(std::span<const ShadeRequest> requests,
                                  std::span<ShadeResult> results) {
    shade_requests(lit_, open_sides_, threads_, requests, results,
                   [&](const SampleRun& run, const Task&, PathWave&) {
                       thread_local BidirectionalScratch scratch;
                       TaskResult result;
                       result.rays = add_bidirectional_samples({lit_, emitters_, open_sides_}, run,
                                                               scratch, result.sums);
                       return result;
                   });
}

}  // namespace chiaro
