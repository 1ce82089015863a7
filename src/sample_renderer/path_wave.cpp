#include "sample_renderer/path_wave.h"

#include "sample_renderer/path_bounce.h"

namespace chiaro {
void ShadowBatch::clear() {
    rays.clear();
    values.clear();
    slots.clear();
}

void ShadowBatch::add(const Ray& ray, Rgb value, std::uint32_t slot) {
    rays.push_back(ray);
    values.push_back(value);
    slots.push_back(slot);
}

void ShadowBatch::settle(const RayCaster& caster, std::span<Rgb> sums) {
    through.resize(rays.size());
    caster.transmittance(rays, through);
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
            if (!hit) continue;
            Path& path = wave.paths[i];
            Ray& ray = wave.rays[i];
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
