#include "sample_renderer/path_wave.h"

#include "sample_renderer/path_bounce.h"

#include <algorithm>

namespace chiaro {
void ShadowBatch::clear() {
    rays.clear();
    values.clear();
    slots.clear();
    second_rays.clear();
    second_of.clear();
}

void ShadowBatch::add(const LightConnection& connection, Rgb value, std::uint32_t slot) {
    if (connection.second_ray) {
        second_rays.push_back(*connection.second_ray);
        second_of.push_back(static_cast<std::uint32_t>(rays.size()));
    }
    rays.push_back(connection.shadow_ray);
    values.push_back(value);
    slots.push_back(slot);
}

void ShadowBatch::settle(const RayCaster& caster, std::span<Rgb> sums) {
    through.resize(std::max(rays.size(), second_rays.size()));
    caster.transmittance(second_rays, std::span(through).first(second_rays.size()));
    for (std::size_t i = 0; i < second_rays.size(); ++i) values[second_of[i]] *= through[i];
    caster.transmittance(rays, std::span(through).first(rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) sums[slots[i]] += through[i] * values[i];
    clear();
}

void PathWave::clear() {
    rays.clear();
    paths.clear();
    shadows.clear();
}

void PathWave::add(const Ray& ray, const Path& path) {
    rays.push_back(ray);
    paths.push_back(path);
}

void follow(const LitScene& lit, PathWave& wave, FirstEmission first, std::span<Rgb> sums,
            const EndsAt* ends_at) {
    for (std::uint32_t bounce = 0; !wave.paths.empty(); ++bounce) {
        if (bounce > 0) {
            wave.hits.resize(wave.rays.size());
            lit.caster.intersect(wave.rays, wave.hits);
        }

        std::size_t alive = 0;
        for (std::size_t i = 0; i < wave.paths.size(); ++i) {
            const Hit& hit = wave.hits[i];
            Path& path = wave.paths[i];
            Ray& ray = wave.rays[i];
            if (!hit) {
                if (!path.first)
                    sums[path.slot] += met_environment(lit, path, ray);
                else if (first == FirstEmission::counted)
                    sums[path.slot] += path.throughput * lit.environment.radiance(ray.direction);
                continue;
            }
            const MetSurface surface = describe(lit, hit);
            if (surface.material.emissive()) {
                if (!path.first)
                    sums[path.slot] += met_emission(lit, path, ray, hit);
                else if (first == FirstEmission::counted)
                    sums[path.slot] += path.throughput * emission(lit.scene, hit.point, hit.front);
            }
            if (lit.dark()) continue;
            const Bounce here = {lit, surface, hit, bounce, ends_at, wave.shadows};
            const bool lambertian = surface.material.gloss.model == GlossModel::none;
            if (!(lambertian ? reflect_diffusely(here, path, ray) : scatter(here, path, ray)))
                continue;
            wave.paths[alive] = path;
            wave.rays[alive] = ray;
            ++alive;
        }
        wave.paths.resize(alive);
        wave.rays.resize(alive);
        wave.shadows.settle(lit.caster, sums);
    }
}

}  // namespace chiaro
