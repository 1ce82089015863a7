#include "sample_renderer/radiance.h"

#include "base/error.h"
#include "base/parallel.h"
#include "sample_renderer/sequence.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr std::uint32_t kWave = 1024;

bool passes(const Scene& scene, const Hit& hit) {
    if (!hit || hit.front) return false;
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(hit.point.object)]);
    return !scene.material(mesh.primitives[hit.point.primitive].material).double_sided;
}

// The rays [first, first + sums.size()), each with samples [from, from + count).
void trace_rays(const LitScene& lit, std::span<const Ray> rays, std::uint32_t first,
                const RadianceSettings& settings, std::uint32_t from, std::uint32_t count,
                std::span<Rgb> sums) {
    thread_local PathWave wave;
    wave.clear();
    for (std::uint32_t i = 0; i < sums.size(); ++i) {
        Ray ray = rays[first + i];
        ray.direction = glm::normalize(ray.direction);
        const std::uint32_t seed = hash32(settings.seed, first + i);
        const Sequence sequence(seed);
        for (std::uint32_t s = from; s < from + count; ++s)
            wave.add(ray, {.slot = i,
                           .key = sample_key(seed, s),
                           .light_place = sequence.pair(s, kFirstLightPlace),
                           .light_choice = sequence.number(s, kFirstLightChoice)});
    }
    wave.hits.resize(wave.rays.size());
    lit.caster.intersect_coherent(wave.rays, wave.hits);
    pass_single_sided_backs(lit.scene, lit.caster, wave.rays, wave.hits);
    follow(lit, wave, FirstEmission::counted, sums);
}

}  // namespace

LitScene make_lit_scene(const Scene& scene, const RayCaster& caster,
                        const AreaLights& area_lights) {
    return {scene, caster, area_lights, {scene, area_lights, cross_section(scene)}};
}

void radiance(const LitScene& lit, std::span<const Ray> rays, const RadianceSettings& settings,
              std::span<Rgb> result) {
    check(rays.size() == result.size(), "radiance: one result a ray");
    check(settings.samples > 0, "radiance: no samples asked for");
    const std::uint32_t samples = settings.samples;
    const std::size_t rays_a_task = std::max(1u, kWave / samples);
    const std::size_t tasks = (rays.size() + rays_a_task - 1) / rays_a_task;
    parallel_for(settings.threads, tasks, [&](std::size_t task) {
        const std::size_t first = task * rays_a_task;
        std::vector<Rgb> sums(std::min(rays_a_task, rays.size() - first));
        std::vector<glm::dvec3> totals(sums.size(), glm::dvec3(0));
        for (std::uint32_t done = 0; done < samples; done += kWave) {
            std::fill(sums.begin(), sums.end(), Rgb(0));
            trace_rays(lit, rays, static_cast<std::uint32_t>(first), settings,
                       settings.first_sample + done, std::min(kWave, samples - done), sums);
            for (std::size_t i = 0; i < sums.size(); ++i) totals[i] += glm::dvec3(sums[i]);
        }
        for (std::size_t i = 0; i < sums.size(); ++i)
            result[first + i] = Rgb(totals[i] / double(samples));
    });
}

void pass_single_sided_backs(const Scene& scene, const RayCaster& caster, std::span<Ray> rays,
                             std::span<Hit> hits) {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (passes(scene, hits[i])) open.push_back(i);

    // Every round passes one face a ray; few rays meet any.
    std::vector<Ray> onward;
    std::vector<Hit> found;
    while (!open.empty()) {
        onward.clear();
        for (const std::size_t i : open) {
            const Vec3 met = rays[i].origin + hits[i].t * rays[i].direction;
            const float step = RayCaster::offset(met) / glm::length(rays[i].direction);
            rays[i].t_min = std::nextafter(hits[i].t + step, kInfinity);
            onward.push_back(rays[i]);
        }
        found.resize(onward.size());
        caster.intersect(onward, found);
        std::size_t kept = 0;
        for (std::size_t k = 0; k < open.size(); ++k) {
            hits[open[k]] = found[k];
            if (passes(scene, found[k])) open[kept++] = open[k];
        }
        open.resize(kept);
    }
}

}  // namespace chiaro
