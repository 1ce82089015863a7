#include "sample_renderer/radiance.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr std::uint32_t kWave = 1024;

// The rays [first, first + sums.size()), each with samples [from, from + count).
void trace_rays(const LitScene& lit, std::span<const Ray> rays, std::uint32_t first,
                const RadianceSettings& settings, std::uint32_t from, std::uint32_t count,
                std::span<Rgb> sums) {
    thread_local PathWave wave;
    wave.clear();
    for (std::uint32_t i = 0; i < sums.size(); ++i) {
        Ray ray = rays[first + i];
        ray.direction = glm::normalize(ray.direction);
        const Sequence sequence(hash32(settings.seed, first + i));
        for (std::uint32_t s = from; s < from + count; ++s)
            wave.add(ray, make_path(sequence, kReplicates * s, i));  // spread best within one
    }
    wave.hits.resize(wave.rays.size());
    lit.caster.intersect_coherent(wave.rays, wave.hits, RayKind::camera);
    follow(lit, wave, FirstEmission::counted, sums);
}

}  // namespace

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

}  // namespace chiaro
