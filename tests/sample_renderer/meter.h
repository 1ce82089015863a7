// A scene made ready for light, and light measured in it.
#pragma once

#include "base/random.h"
#include "sample_renderer/path_renderer.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/tiny_scenes.h"

#include <vector>

namespace chiaro::tiny {

/// Everything that the renderer `path` needs of one scene, at fixed seeds.
struct Meter {
    Scene scene;
    RayCaster caster;
    AreaLights area_lights;
    OpenSides open_sides;
    LitScene lit;

    explicit Meter(Scene s)
        : scene(std::move(s)),
          caster(scene, 1),
          area_lights(scene),
          open_sides(scene),
          lit(make_lit_scene(scene, caster, area_lights)) {}
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
        PathRenderer renderer(scene, caster, area_lights, nullptr, 1);
        return at(renderer, position, normal, light, samples, seed);
    }
    static ShadeResult at(SampleRenderer& renderer, Vec3 position, Vec3 normal, Light light,
                          std::uint32_t samples, std::uint32_t seed = 1) {
        const ShadeRequest request = {.place = MeterPlace{position, normal},
                                      .light = light,
                                      .seed = seed,
                                      .samples = samples,
                                      .indirect_samples = samples};
        ShadeResult result;
        renderer.shade({&request, 1}, {&result, 1});
        return result;
    }
    float lux(Vec3 position, Vec3 normal, Light light, std::uint32_t samples) const {
        return luminance(at(position, normal, light, samples).mean);
    }

    std::vector<ShadeResult> shade(const std::vector<ShadeRequest>& requests, int threads = 1) {
        std::vector<ShadeResult> results(requests.size());
        PathRenderer(scene, caster, area_lights, &open_sides, threads).shade(requests, results);
        return results;
    }
};

}  // namespace chiaro::tiny
