// A scene made ready for light, and light measured in it.
#pragma once

#include "base/random.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/tiny_scenes.h"
#include "sample_renderer/truths.h"

#include <memory>
#include <vector>

namespace chiaro::tiny {

/// Asks one that remembers twice: then its cells are filled.
inline void shade(SampleRenderer& renderer, std::span<const ShadeRequest> requests,
                  std::span<ShadeResult> results) {
    if (renderer.remembers()) renderer.shade(requests, results);
    renderer.shade(requests, results);
}

/// Everything that renderers need of one scene, at fixed seeds.
struct Meter {
    Scene scene;
    RayCaster caster;
    AreaLights area_lights;
    OpenSides open_sides;
    LitScene lit;
    Truth by;
    std::unique_ptr<SampleRenderer> single;  // of one thread, for places that need no surface

    explicit Meter(Scene s, Truth told_by = Truth::path)
        : scene(std::move(s)),
          caster(scene, 1),
          area_lights(scene),
          open_sides(scene),
          lit(make_lit_scene(scene, caster, area_lights)),
          by(told_by),
          single(make_renderer(by, scene, caster, area_lights, nullptr, 1)) {}
    Meter(const Meter&) = delete;
    Meter& operator=(const Meter&) = delete;

    /// The surface point that a look from `from` along `direction` meets first.
    Hit look(Vec3 from, Vec3 direction) const {
        const Ray ray = {from, direction};
        Hit hit;
        caster.intersect({&ray, 1}, {&hit, 1});
        return hit;
    }

    /// Light at a place that need not lie on a surface.
    ShadeResult at(Vec3 position, Vec3 normal, Light light, std::uint32_t samples,
                   std::uint32_t seed = 1) const {
        return at(*single, position, normal, light, samples, seed);
    }
    static ShadeResult at(SampleRenderer& renderer, Vec3 position, Vec3 normal, Light light,
                          std::uint32_t samples, std::uint32_t seed = 1) {
        const ShadeRequest request = {.place = MeterPlace{position, normal},
                                      .light = light,
                                      .seed = seed,
                                      .samples = samples,
                                      .indirect_samples = samples};
        ShadeResult result;
        tiny::shade(renderer, {&request, 1}, {&result, 1});
        return result;
    }
    /// Samples that take the time of so many of `path`, or less. In the tests' rooms they leave up
    /// to twice its noise.
    std::uint32_t worth(std::uint32_t samples_of_path) const {
        return by == Truth::path ? samples_of_path : samples_of_path / 4;
    }

    float lux(Vec3 position, Vec3 normal, Light light, std::uint32_t samples) const {
        return luminance(at(position, normal, light, samples).mean);
    }

    std::vector<ShadeResult> shade(const std::vector<ShadeRequest>& requests, int threads = 1) {
        std::vector<ShadeResult> results(requests.size());
        const auto renderer = make_renderer(by, scene, caster, area_lights, &open_sides, threads);
        tiny::shade(*renderer, requests, results);
        return results;
    }
};

}  // namespace chiaro::tiny
