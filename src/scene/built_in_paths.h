// How the built-in scenes are walked through, and what moves in them meanwhile.
#pragma once

#include "base/vec.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chiaro {

/// Where the camera stands and looks at a time [s], in world space.
struct CameraKey {
    float time;
    Vec3 eye, target;
};

/// Where an object is at a time [s]: turned about the centre of its bounds, then moved, from its
/// place in the scene, all in world space.
struct ObjectKey {
    float time;
    Vec3 translate;
    Vec3 axis;
    float degrees;
};

/// Keys in order of time, from 0; between them one goes on evenly or more smoothly.
struct BuiltInPaths {
    std::vector<CameraKey> camera;
    std::string object;  // by name
    std::vector<ObjectKey> object_keys;
};

/// Of the built-in scene called `name`; nothing if it has none. In `room` the lamp moves, in
/// `indirect` the chair, in `poolhall` the cue ball while the camera goes round the others.
std::optional<BuiltInPaths> built_in_paths(std::string_view name);

}  // namespace chiaro
