#include "sample_renderer/caustic_renderer.h"

#include "sample_renderer/mirror_light.h"
#include "scene/bsdf.h"

#include <algorithm>

namespace chiaro {
namespace {

// Up to this many pairs of a mirror and a light are all tried at a shading point, once, which
// leaves no noise; of more, each sample tries some.
constexpr std::size_t kMostExactImages = 1024;
constexpr std::size_t kImagesASample = 16;

// What reflects or transmits less makes no light that stands out.
constexpr float kLeastFocus = 0.15f;
constexpr float kRoughestFocus = 0.6f;  // perceptual roughness

Rgb exact_image_light(const LitScene& lit, const Receiver& receiver, PathWave& scratch) {
    scratch.shadows.clear();
    for_each_image(lit, receiver, 0, kMostExactImages, [&](const LightConnection& found) {
        scratch.shadows.add(found, found.irradiance, 0);
    });
    Rgb sum(0);
    scratch.shadows.settle(lit.caster, {&sum, 1});
    return sum;
}

void add_image_samples(const LitScene& lit, const SampleRun& run, PathWave& scratch,
                       std::span<Rgb, kReplicates> sums) {
    const Sequence sequence(run.seed);
    scratch.shadows.clear();
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i)
        for_each_image(lit, run.receiver, sequence.number(i, kFirstLightChoice), kImagesASample,
                       [&](const LightConnection& found) {
                           scratch.shadows.add(found, found.irradiance, i % kReplicates);
                       });
    scratch.shadows.settle(lit.caster, sums);
}

// What a material focuses, by one of its places.
float focusing_part(const Scene& scene, const SurfacePoint& place) {
    const Bsdf b = bsdf_at(scene, place, true);
    if (b.alpha > kRoughestFocus * kRoughestFocus) return 0;
    const float reflected = has_facets(b) ? (1 - b.glass) * max_component(b.f0) : 0.0f;
    const float part = std::max(reflected, b.thin ? 0.0f : b.glass);
    return part < kLeastFocus ? 0.0f : part;
}

// The surfaces of a scene that focus light: metal and bodies of glass, by how much they reflect or
// transmit. Panes are none.
SampledSurfaces focusing_surfaces(const Scene& scene) {
    std::vector<SurfaceWeight> weights(scene.materials.size());
    std::vector<char> known(scene.materials.size(), 0);
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        if (scene.objects[o].mesh == MeshId::none || !scene.objects[o].shown) continue;
        const std::vector<Primitive>& primitives = scene.mesh_of(scene.objects[o]).primitives;
        for (std::uint32_t p = 0; p < primitives.size(); ++p) {
            const std::size_t material = index_of(primitives[p].material);
            if (known[material]) continue;
            known[material] = 1;
            weights[material].weight =
                focusing_part(scene, {static_cast<ObjectId>(o), p, 0.25f, 0.25f});
        }
    }
    return SampledSurfaces(scene, weights);
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
    const Aims all = {focusing_};
    const Aims* aims = focusing_.empty() ? nullptr : &all;
    shade_requests(lit_, open_sides_, threads_, requests, results,
                   [&](const SampleRun& run, const Task& task, PathWave& scratch) {
                       TaskResult result;
                       if (exact && task.starts)
                           result.exact = exact_image_light(lit_, run.receiver, scratch);
                       if (!exact) add_image_samples(lit_, run, scratch, result.sums);
                       result.rays =
                           add_indirect_samples(lit_, {&run, 1}, scratch, result.sums,
                                                {.open_sides = open_sides_, .aims = aims});
                       return result;
                   });
}

}  // namespace chiaro
