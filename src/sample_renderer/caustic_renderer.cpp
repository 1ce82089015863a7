#include "sample_renderer/caustic_renderer.h"

#include "sample_renderer/mirror_light.h"

namespace chiaro {
namespace {

// Up to this many pairs of a mirror and a light are all tried at a shading point, once, which
// leaves no noise; of more, each sample tries some.
constexpr std::size_t kMostExactImages = 1024;
constexpr std::size_t kImagesASample = 16;

Rgb exact_image_light(const LitScene& lit, const Receiver& receiver, PathWave& scratch) {
    scratch.shadows.clear();
    for_each_image(lit, receiver, 0, kMostExactImages, [&](const LightConnection& found) {
        scratch.shadows.add(found, found.irradiance, 0);
    });
    Rgb sum(0);
    scratch.shadows.settle(lit.caster, {&sum, 1});
    return sum;
}

void add_image_samples(const LitScene& lit, const Receiver& receiver, std::uint32_t seed,
                       const Task& task, PathWave& scratch, std::span<Rgb, kReplicates> sums) {
    const Sequence sequence(seed);
    scratch.shadows.clear();
    for (std::uint32_t i = task.first; i < task.first + task.count; ++i)
        for_each_image(lit, receiver, sequence.number(i, kFirstLightChoice), kImagesASample,
                       [&](const LightConnection& found) {
                           scratch.shadows.add(found, found.irradiance, i % kReplicates);
                       });
    scratch.shadows.settle(lit.caster, sums);
}

}  // namespace

CausticRenderer::CausticRenderer(const Scene& scene, const RayCaster& caster,
                                 const AreaLights& area_lights, const OpenSides* open_sides,
                                 int threads)
    : lit_(make_lit_scene(scene, caster, area_lights)),
      open_sides_(open_sides),
      threads_(threads),
      focusing_(focusing_surfaces(scene)),
      mirrors_(find_flat_mirrors(scene)) {
    lit_.mirrors = mirrors_;
}

SampleCosts CausticRenderer::typical_costs() const {
    return {.direct = 0.12e-6f, .indirect = 1.8e-6f};
}

void CausticRenderer::shade(std::span<const ShadeRequest> requests,
                            std::span<ShadeResult> results) {
    const bool exact = image_count(lit_) <= kMostExactImages;
    shade_requests(
        lit_, open_sides_, threads_, requests, results,
        [&](const Receiver& receiver, const Task& task, std::uint32_t seed, PathWave& scratch) {
            TaskResult result;
            if (exact && task.starts) result.exact = exact_image_light(lit_, receiver, scratch);
            if (!exact) add_image_samples(lit_, receiver, seed, task, scratch, result.sums);
            result.rays = add_caustic_samples(lit_, focusing_, open_sides_, receiver, seed,
                                              task.first, task.count, scratch, result.sums);
            return result;
        });
}

}  // namespace chiaro
