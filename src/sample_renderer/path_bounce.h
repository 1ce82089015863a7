// One bounce of a path: what the surface that it met emits, what that scatters of the lights, and
// where the path goes on.
#pragma once

#include "sample_renderer/path_wave.h"

namespace chiaro {

/// What a path needs to know of the surface that it met.
struct MetSurface {
    Receiver receiver;  // on the side that the ray came from
    Rgb base_color;
    const Material& material;
};
MetSurface describe(const LitScene& lit, const Hit& hit);

/// Emission that a ray of a path met by chance, weighted: next event estimation where the ray
/// started may have found it too.
Rgb met_emission(const LitScene& lit, const Path& path, const Ray& ray, const Hit& hit);

/// The same of the environment, by a ray that met nothing.
Rgb met_environment(const LitScene& lit, const Path& path, const Ray& ray);

/// What a smooth pane lets straight on of the ray that met it, whose t_min is set beyond; black at
/// all else.
Rgb passed_straight(const LitScene& lit, const Hit& hit, Ray& ray);

/// Lets a ray go on through a pane that it met. It remains one ray: its start and its density are
/// what light samples compare with.
void pass_pane(const Hit& hit, Ray& ray);

/// Casts the rays of a wave that end at the first surface they meet, and those that panes let
/// straight on again. Calls met(path, ray, hit) at each surface and missed(path, ray) where there
/// is none; the wave is empty in the end.
template <typename Met, typename Missed>
void cast_through_panes(const LitScene& lit, PathWave& wave, const Met& met, const Missed& missed) {
    while (!wave.rays.empty()) {
        wave.hits.resize(wave.rays.size());
        lit.caster.intersect(wave.rays, wave.hits);
        std::size_t left = 0;
        for (std::size_t i = 0; i < wave.rays.size(); ++i) {
            Path path = wave.paths[i];
            Ray ray = wave.rays[i];
            const Hit& hit = wave.hits[i];
            if (!hit) {
                missed(path, ray);
                continue;
            }
            met(path, ray, hit);
            path.throughput *= passed_straight(lit, hit, ray);
            if (!(max_component(path.throughput) > 0)) continue;
            wave.paths[left] = path;
            wave.rays[left++] = ray;
        }
        wave.paths.resize(left);
        wave.rays.resize(left);
    }
}

/// Where a path is.
struct Bounce {
    const LitScene& lit;
    const MetSurface& surface;
    const Hit& hit;
    std::uint32_t number;
    const EndsAt* ends_at;  // may be null
    ShadowBatch& shadows;   // takes the light that the surface reflects
};

/// Light from one light of each kind, and the next ray; false if the path ends. For any surface;
/// diffuse_bounce.h has what is quicker on Lambertian ones.
bool scatter(const Bounce& here, Path& path, Ray& ray);

}  // namespace chiaro
