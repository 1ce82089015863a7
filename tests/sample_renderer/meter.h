// A scene made ready for light, and light measured in it.
#pragma once

#include "base/random.h"
#include "sample_renderer/bidirectional_renderer.h"
#include "sample_renderer/caustic_renderer.h"
#include "sample_renderer/gather_renderer.h"
#include "sample_renderer/path_renderer.h"
#include "sample_renderer/radiance.h"
#include "sample_renderer/tiny_scenes.h"

#include <memory>
#include <vector>

namespace chiaro::tiny {

/// The renderers, all of which tell the truth; `gather` within its published bias
/// (docs/results.md).
enum class Truth { path, bidirectional, caustic, gather };
inline constexpr Truth kTruths[] = {Truth::path, Truth::bidirectional, Truth::caustic,
                                    Truth::gather};
inline constexpr double kGatherBias = 0.015;

/// A tolerance that was chosen for the noise of `path`, for what others leave of it and for their
/// bias (Meter::worth()).
inline double within(Truth by, double tolerance) {
    switch (by) {
        case Truth::path:
            return tolerance;
        case Truth::bidirectional:
            return 1.5 * tolerance;
        case Truth::caustic:
            return 2 * tolerance;
        case Truth::gather:
            break;
    }
    return tolerance + kGatherBias;
}

inline std::unique_ptr<SampleRenderer> make_renderer(Truth by, const Scene& scene,
                                                     const RayCaster& caster,
                                                     const AreaLights& area_lights,
                                                     const OpenSides* sides, int threads) {
    const auto make = [&]<typename Renderer>() {
        return std::make_unique<Renderer>(scene, caster, area_lights, sides, threads);
    };
    switch (by) {
        case Truth::path:
            break;
        case Truth::bidirectional:
            return make.operator()<BidirectionalRenderer>();
        case Truth::caustic:
            return make.operator()<CausticRenderer>();
        case Truth::gather:
            return make.operator()<GatherRenderer>();
    }
    return make.operator()<PathRenderer>();
}

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
