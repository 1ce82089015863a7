// What edits change of what rays from the eye see: which part of the map is to be made anew.
#pragma once

#include "update/scene_change.h"

namespace chiaro {

/// Lights without a surface are not seen: where they alone change, nothing is to be seen again.
struct ViewChange {
    bool everywhere = false;  // the eye has moved, or a material looks otherwise
    std::vector<Box> boxes;   // world space: else only rays through these see something else

    bool any() const { return everywhere || !boxes.empty(); }
    void add(const ViewChange& later);
};

ViewChange view_change_of(const SceneChange& change);

}  // namespace chiaro
