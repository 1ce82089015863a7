#include "sample_renderer/bright_surfaces.h"

#include "base/halton.h"
#include "base/parallel.h"
#include "sample_renderer/emitters.h"

namespace chiaro {
namespace {

constexpr std::uint32_t kRays = 1 << 16;
constexpr std::uint32_t kRaysATask = 1 << 12;

// Fewer that landed may have done so by luck.
constexpr std::uint32_t kEnoughRays = 12;

// What rays from the lights brought to one primitive.
struct Landed {
    float flux = 0;  // luminous [lumen]
    std::uint32_t rays = 0;
};
using LandedOn = std::vector<std::vector<Landed>>;  // by object, by primitive

// Casts rays [first, first + kRaysATask); `flux` gets what each brings.
void cast_from_lights(const LitScene& lit, const Emitters& emitters, std::uint32_t first,
                      std::span<Hit> hits, std::span<float> flux) {
    std::vector<Ray> rays(kRaysATask, {.t_max = -1});
    for (std::uint32_t i = 0; i < kRaysATask; ++i) {
        const std::uint32_t n = first + i;
        const auto found = emitters.sample(lit, halton(4, n), {halton(2, n), halton(3, n)},
                                           {halton(0, n), halton(1, n)});
        if (!found) continue;
        rays[i] = found->ray;
        flux[i] = luminance(found->flux) / static_cast<float>(kRays);
    }
    lit.caster.intersect(rays, hits);
}

LandedOn shine(const LitScene& lit, int threads) {
    LandedOn landed(lit.scene.objects.size());
    const Emitters emitters(lit);
    if (emitters.empty()) return landed;
    std::vector<Hit> hits(kRays);
    std::vector<float> flux(kRays, 0.0f);
    parallel_for(threads, kRays / kRaysATask, [&](std::size_t task) {
        const auto first = static_cast<std::uint32_t>(task * kRaysATask);
        cast_from_lights(lit, emitters, first, std::span(hits).subspan(first, kRaysATask),
                         std::span(flux).subspan(first, kRaysATask));
    });

    // In order, so that the sums have the same bits on any number of threads.
    for (std::uint32_t i = 0; i < kRays; ++i) {
        if (!hits[i] || !(flux[i] > 0)) continue;
        const SurfacePoint& point = hits[i].point;
        std::vector<Landed>& on_object = landed[index_of(point.object)];
        if (on_object.empty())
            on_object.resize(
                lit.scene.mesh_of(lit.scene.objects[index_of(point.object)]).primitives.size());
        Landed& here = on_object[point.primitive];
        here.flux += flux[i];
        ++here.rays;
    }
    return landed;
}

}  // namespace

SampledSurfaces bright_surfaces(const LitScene& lit, int threads) {
    const Scene& scene = lit.scene;
    const LandedOn landed = shine(lit, threads);
    std::vector<float> reflectances;
    for (const Material& material : scene.materials)
        reflectances.push_back(luminance(mean_reflectance(scene, material)));
    const auto reflected = [&](ObjectId object, std::uint32_t primitive) {
        const MaterialId material = material_of(scene, {object, primitive});
        return landed[index_of(object)][primitive].flux * reflectances[index_of(material)];
    };

    // The mean over the area that any light fell on.
    double flux = 0, area = 0;
    for (std::size_t o = 0; o < landed.size(); ++o)
        for (std::uint32_t p = 0; p < landed[o].size(); ++p) {
            if (landed[o][p].rays == 0) continue;
            flux += double(reflected(static_cast<ObjectId>(o), p));
            area += double(primitive_area(scene, static_cast<ObjectId>(o), p));
        }
    const double least = kBright * flux / area;

    return SampledSurfaces(scene, [&](ObjectId object, std::uint32_t p) -> SurfaceWeight {
        const std::vector<Landed>& on_object = landed[index_of(object)];
        if (on_object.empty() || on_object[p].rays < kEnoughRays) return {};
        const float radiosity = reflected(object, p) / primitive_area(scene, object, p);
        return {radiosity > least ? radiosity : 0.0f, true};
    });
}

}  // namespace chiaro
