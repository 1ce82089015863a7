#include "scene/animation.h"

#include "base/error.h"

#include <algorithm>

namespace chiaro {
namespace {

glm::quat quat_of(Vec4 v) {
    return {v.w, v.x, v.y, v.z};
}

// Along the shorter arc.
Vec4 turn_between(Vec4 a, Vec4 b, float part) {
    const glm::quat q = glm::slerp(glm::normalize(quat_of(a)), glm::normalize(quat_of(b)), part);
    return {q.x, q.y, q.z, q.w};
}

// Hermite's spline between keys `i` and i + 1, as in glTF 2.0, appendix C.
Vec4 on_spline(const AnimationChannel& c, std::size_t i, float part, float length) {
    const Vec4 from = c.values[3 * i + 1], leaving = length * c.values[3 * i + 2];
    const Vec4 to = c.values[3 * i + 4], arriving = length * c.values[3 * i + 3];
    const float t = part, tt = t * t, ttt = tt * t;
    return (2 * ttt - 3 * tt + 1) * from + (ttt - 2 * tt + t) * leaving + (3 * tt - 2 * ttt) * to +
           (ttt - tt) * arriving;
}

}  // namespace

glm::dmat4 matrix_of(const Pose& pose) {
    glm::dmat4 matrix = glm::mat4_cast(glm::normalize(pose.rotation));
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= pose.scale[axis];
    matrix[3] = glm::dvec4(pose.translation, 1);
    return matrix;
}

Vec4 value_at(const AnimationChannel& c, float seconds) {
    const bool cubic = c.interpolation == Interpolation::cubic;
    check(!c.times.empty() && c.values.size() == c.times.size() * (cubic ? 3 : 1),
          "value_at: a channel needs keys and a value for each");
    const auto value = [&](std::size_t i) { return c.values[cubic ? 3 * i + 1 : i]; };
    const auto next = std::upper_bound(c.times.begin(), c.times.end(), seconds);
    if (next == c.times.begin()) return value(0);
    const auto i = static_cast<std::size_t>(next - c.times.begin() - 1);
    if (next == c.times.end() || c.interpolation == Interpolation::step) return value(i);

    const float length = c.times[i + 1] - c.times[i];
    const float part = (seconds - c.times[i]) / length;
    if (cubic) return on_spline(c, i, part, length);
    if (c.part == AnimatedPart::rotation) return turn_between(value(i), value(i + 1), part);
    return glm::mix(value(i), value(i + 1), part);
}

}  // namespace chiaro
