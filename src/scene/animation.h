// What moves by itself: a file's hierarchy of transforms, and how its nodes change with time.
#pragma once

#include "base/ids.h"
#include "base/vec.h"

#include <glm/gtc/quaternion.hpp>

#include <string>
#include <variant>
#include <vector>

namespace chiaro {

/// Scaled, then turned, then moved.
struct Pose {
    glm::dvec3 translation = glm::dvec3(0);
    glm::dquat rotation = glm::dquat(1, 0, 0, 0);  // of any length above 0
    glm::dvec3 scale = glm::dvec3(1);
};
glm::dmat4 matrix_of(const Pose& pose);

/// A transform in the hierarchy, and what hangs on it.
struct SceneNode {
    std::string name;              // as in the file; several nodes may share one
    NodeId parent = NodeId::none;  // before this one in Scene::nodes
    std::variant<Pose, glm::dmat4> to_parent = Pose{};  // an animated node has a pose
    ObjectId object = ObjectId::none;
    LightId light = LightId::none;
    CameraId camera = CameraId::none;
};

enum class AnimatedPart : std::uint8_t { translation, rotation, scale };
enum class Interpolation : std::uint8_t { step, linear, cubic };

/// One part of one node's pose over time; before the first key and after the last it rests.
struct AnimationChannel {
    NodeId node = NodeId::none;
    AnimatedPart part = AnimatedPart::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  // [s], rising, at least one
    /// One a time; rotations are quaternions x, y, z, w. Cubic: three a time, tangent on the way
    /// in, value, tangent on the way out (glTF 2.0, appendix C).
    std::vector<Vec4> values;
};

struct Animation {
    std::string name;
    float duration = 0;  // [s], to the last key
    std::vector<AnimationChannel> channels;
};

/// The part of the pose at a time [s].
Vec4 value_at(const AnimationChannel& channel, float seconds);

}  // namespace chiaro
