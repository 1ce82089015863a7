// One bounce of paths that met Lambertian surfaces, eight at a time: most bounces of most scenes.
#pragma once

#include "sample_renderer/path_wave.h"

namespace chiaro {

/// Where eight neighbours of a wave are; lane i has the path first + i.
struct DiffuseBounce {
    const LitScene& lit;
    PathWave& wave;  // its hits are of the present rays; its shadows take reflected light
    std::size_t first;
    std::uint32_t number;
    const EndsAt* ends_at;    // may be null
    std::uint32_t lanes = 0;  // a bit for each lane on a Lambertian surface, whose
    Lanes3 base_color = Lanes3(),
           shading_normal = Lanes3();  // are set; the normal of the front side

    int lane_count() const {
        return static_cast<int>(std::min<std::size_t>(kLanes, wave.paths.size() - first));
    }
};

/// The same paths with the rays that go on.
struct EightPaths {
    Path paths[kLanes];
    Ray rays[kLanes];
};

/// Light from one light of each kind, and the next rays; returns the lanes whose paths go on.
std::uint32_t reflect_diffusely(const DiffuseBounce& here, EightPaths& next);

}  // namespace chiaro
