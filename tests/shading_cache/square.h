// A mesh of one square, on which nothing is known yet.
#pragma once

#include "shading_cache/cache_testing.h"

namespace chiaro::tiny {

struct Square {
    Scene scene = grid(1, 1);
    MeshGraphs graphs{scene, CoarserLevels::none, 1};
    ShadingCache cache;
    PatchId root;
    std::array<VertexId, 4> corners;

    explicit Square(Channels channels = {.irradiance = 1})
        : cache(scene, graphs, channels, SplitRule::always_four) {
        root = cache.root(ObjectId{0}, 0, true);
        corners = cache.patch(root).corners;
    }
    Square(const Square&) = delete;
    Square& operator=(const Square&) = delete;
};

}  // namespace chiaro::tiny
