// A scene made ready for light, and light measured in it.
#pragma once

#include "base/random.h"
#include "sample_renderer/bidirectional_renderer.h"
#include "sample_renderer/path_renderer.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/tiny_scenes.h"

#include <memory>
#include <vector>

namespace chiaro::tiny {

/// The renderers that tell the truth, whatever the scene.
enum class Truth { path, bidirectional };
inline constexpr Truth kTruths[] = {Truth::path, Truth::bidirectional};

/// A tolerance that was chosen for the noise of `path`, for that of others (Meter::worth()).
inline double within(Truth by, double tolerance) {
    return by == Truth::path ? tolerance : 1.5 * tolerance;
}

/// Everything that renderers need of one scene, at fixed seeds.
struct Meter {
    Scene scene;
    RayCaster caster;
    AreaLights area_lights;
    OpenSides open_sides;
    LitScene lit;
    Truth by;

    explicit Meter(Scene s, Truth told_by = Truth::path)
        : scene(std::move(s)),
          caster(scene, 1),
          area_lights(scene),
          open_sides(scene),
          lit(make_lit_scene(scene, caster, area_lights)),
          by(told_by) {}
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
        return at(*renderer(nullptr, 1), position, normal, light, samples, seed);
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
    /// Samples that take about the time of so many of `path`. In the tests' rooms they leave up to
    /// 1.5 times its noise.
    std::uint32_t worth(std::uint32_t samples_of_path) const {
        return by == Truth::path ? samples_of_path : samples_of_path / 4;
    }

    float lux(Vec3 position, Vec3 normal, Light light, std::uint32_t samples) const {
        return luminance(at(position, normal, light, samples).mean);
    }

    std::vector<ShadeResult> shade(const std::vector<ShadeRequest>& requests, int threads = 1) {
        std::vector<ShadeResult> results(requests.size());
        renderer(&open_sides, threads)->shade(requests, results);
        return results;
    }

    std::unique_ptr<SampleRenderer> renderer(const OpenSides* sides, int threads) const {
        if (by == Truth::bidirectional)
            return std::make_unique<BidirectionalRenderer>(scene, caster, area_lights, sides,
                                                           threads);
        return std::make_unique<PathRenderer>(scene, caster, area_lights, sides, threads);
    }
};

}  // namespace chiaro::tiny
