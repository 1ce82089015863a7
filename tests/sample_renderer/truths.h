// The renderers that tests ask for the truth, and how near each must come.
#pragma once

#include "sample_renderer/bidirectional_renderer.h"
#include "sample_renderer/caustic_renderer.h"
#include "sample_renderer/gather_renderer.h"
#include "sample_renderer/path_renderer.h"

#include <memory>

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

}  // namespace chiaro::tiny
