#include "scene/camera.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chiaro {
namespace {

// To the right of someone who looks along `forward` (unit); any level direction will do for one who
// looks straight up or down.
Vec3 right_of(Vec3 forward, Vec3 up) {
    const Vec3 right = glm::cross(forward, up);
    const float length = glm::length(right);
    if (length > 1e-6f * glm::length(up)) return right / length;
    return Frame(forward).s;
}

// Lowest and highest coordinate of the box along `axis`.
struct Extent {
    float low, high;
    float size() const { return high - low; }
    float at(float fraction) const { return low + fraction * size(); }
};

Extent extent_along(const Box& box, Vec3 axis) {
    const float centre = glm::dot(box.centre(), axis);
    const float reach = 0.5f * glm::dot(box.high - box.low, glm::abs(axis));
    return {centre - reach, centre + reach};
}

}  // namespace

View::View(const Camera& camera, int width, int height)
    : width_(width), height_(height), eye_(camera.eye) {
    check(width > 0 && height > 0, "View: a picture needs at least one pixel");
    const Vec3 gaze = camera.target - camera.eye;
    const float distance = glm::length(gaze);
    const Vec3 forward = distance > 0 ? gaze / distance : Vec3(0, 0, -1);
    const Vec3 right = right_of(forward, camera.up);
    const Vec3 down = glm::cross(forward, right);

    // One pixel on the plane at distance 1: square, so the width follows from the height.
    const float half_height = std::tan(glm::radians(0.5f * camera.vertical_fov));
    const float pixel = 2 * half_height / static_cast<float>(height);
    right_ = pixel * right;
    down_ = pixel * down;
    corner_ = forward - 0.5f * static_cast<float>(width) * right_ -
              0.5f * static_cast<float>(height) * down_;
}

Ray View::ray(float x, float y) const {
    return {.origin = eye_, .direction = glm::normalize(corner_ + x * right_ + y * down_)};
}

Camera frame_from_inside(const Box& bounds, Vec3 up) {
    Camera camera = {.name = "inside", .up = up, .vertical_fov = 60};
    if (bounds.empty()) return camera;

    // In a frame whose third axis is the vertical. A scene without height (a lone floor) is seen
    // from as high as it is wide.
    const Frame frame(glm::normalize(up));
    const Extent across = extent_along(bounds, frame.s);
    const Extent along = extent_along(bounds, frame.t);
    Extent height = extent_along(bounds, frame.n);
    const float width = std::max(across.size(), along.size());
    if (height.size() < 0.01f * width) height.high = height.low + width;

    // Near a corner, but off its walls and off its diagonal, on which a room looks too even.
    constexpr float kEyeHeight = 0.55f;
    camera.eye = frame.to_world(Vec3(across.at(0.9f), along.at(0.06f), height.at(kEyeHeight)));
    camera.target = bounds.centre();
    if (camera.eye == camera.target) camera.eye += frame.s;
    return camera;
}

}  // namespace chiaro
