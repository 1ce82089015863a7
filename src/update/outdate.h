// What an edit makes stale in the cache, as exactly as it can be known (design, section 5).
#pragma once

#include "sample_selector/priority_map.h"
#include "scene/light_reach.h"
#include "update/expected_change.h"
#include "update/eye_track.h"
#include "update/scene_change.h"
#include "update/shade_work.h"

namespace chiaro {

/// Luminances that changes of darkness are measured by, a tenth of what a picture's middle tones
/// need: irradiance [lux] and glossy radiance [cd/m2].
struct LeastLight {
    float irradiance = 0;
    float glossy = 0;
    float of(Shading shading) const { return shading == Shading::glossy ? glossy : irradiance; }
};
LeastLight least_light(const PictureScale& scale);

/// What relative errors at a vertex are relative to, squared: all light that adds up with the
/// channel's, there or where it is predicted from (one that is dark by bad luck among lit ones is
/// not known well), and the least.
float light2(const ShadingCache& cache, VertexId vertex, int channel, const LeastLight& least);

/// Makes stale what `change`, which the scene has behind it, may have reached, and tells `expected`
/// of it.
///
/// Direct light is stale where lights changed, on what moved, and where a segment to a light
/// crosses a place that something left or came to; elsewhere it stays. All other light is stale
/// everywhere, since light goes round corners. What was buried or dark, and may not be any more, is
/// forgotten: also what is buried by something that stands, where other light may come to it now.
void outdate(ShadingCache& cache, const Scene& scene, std::span<const ChannelPlan> plans,
             const SceneChange& change, const LeastLight& least, ExpectedChange& expected,
             int threads);

/// The eye, which has been on a track until now, has moved.
struct EyeMove {
    const EyeTrack& track;
    Cycle now;
    Vec3 eye;  // where it is
};

/// Glossy light is stale, the more so the farther the eye has turned round a surface since that was
/// shaded, in however small steps, and the glossier it looks (5.1); forgotten where most shows
/// something else. Returns how glossy the glossiest vertex of each object looks, at least 1
/// (PerceivedGloss::strength()); 0: of none.
std::vector<float> outdate_gloss(ShadingCache& cache, const Scene& scene, const EyeMove& move,
                                 const LeastLight& least, ExpectedChange& expected, int threads);

/// Estimates that are stale.
struct StaleCount {
    std::size_t all = 0;
    std::size_t in_view = 0;  // the picture shows what they tell, not being buried
};

/// Cycles since light became stale: by edits, and of gloss by the eye's motion too.
struct Waiting {
    Cycle irradiance = 0, glossy = 0;
    Cycle of(Shading shading) const { return shading == Shading::glossy ? glossy : irradiance; }
};

/// Takes what was found meanwhile for what is stale still: each of these may be off by as much as
/// others on its object were, and by more the longer it waits, so that all in view have their turn.
/// Where nobody would sample it, as the channel is not refined so far, it is forgotten: it is
/// predicted then.
StaleCount reconsider_stale(ShadingCache& cache, const ExpectedChange& expected,
                            const LeastLight& least, const Waiting& waiting, int threads);

}  // namespace chiaro
