// What can stand in the way of light: which direct light an edit can have changed, and which not.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace chiaro {

/// Where all that shines directly is, each light in a box of its own. Describes the lights as they
/// were when it was made.
///
/// Thread: const calls from any number of threads.
class LightReach {
public:
    explicit LightReach(const Scene& scene);

    /// False only if no segment from `point` to a point of any light meets `box`: what moves within
    /// the box leaves direct light at the point as it is. (World space.)
    bool may_cross(Vec3 point, const Box& box) const;

private:
    struct Place {
        Vec3 centre, extent;  // half the lengths of its box
    };
    std::vector<Place> places_;
    std::vector<Vec3> suns_;   // unit, toward each
    bool everywhere_ = false;  // there is light from all directions
};

}  // namespace chiaro
