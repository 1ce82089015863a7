// Where the eye was when.
#pragma once

#include "base/vec.h"
#include "shading_cache/patch.h"

#include <deque>

namespace chiaro {

/// Remembers the eye's places as far back as estimates tell their age.
class EyeTrack {
public:
    /// From cycle `now` on the eye is there; cycles do not go back.
    void move_to(Vec3 eye, Cycle now);

    /// Where the eye was when an estimate was shaded, not after cycle `now`. Checks: it has been
    /// somewhere.
    Vec3 at(const Estimate& estimate, Cycle now) const;

private:
    struct Place {
        Cycle from;
        Vec3 eye;
    };
    std::deque<Place> places_;  // by cycle
};

}  // namespace chiaro
