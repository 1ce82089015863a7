// A pinhole view.
#pragma once

#include "base/vec.h"

#include <string>

namespace chiaro {

/// `eye`, `target` in world space; `up` need not be perpendicular. A picture's aspect comes from
/// its size in pixels; pixels are square.
struct Camera {
    std::string name;
    Vec3 eye = Vec3(0, 0, 1);
    Vec3 target = Vec3(0);
    Vec3 up = Vec3(0, 1, 0);
    float vertical_fov = 45;  // degrees, in (0, 180)

    bool operator==(const Camera&) const = default;
};

/// A camera made ready for one picture size: rays by pixel.
class View {
public:
    View(const Camera& camera, int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    Vec3 eye() const { return eye_; }

    /// Ray through the picture point (x, y), in pixels from the top left corner: the centre of
    /// pixel (i, j) is (i + 0.5, j + 0.5). The direction is of unit length.
    Ray ray(float x, float y) const;

private:
    int width_, height_;
    Vec3 eye_, corner_, right_, down_;
};

/// A camera for a scene that has none: inside `bounds`, near a corner at eye height, looking at the
/// centre.
Camera frame_from_inside(const Box& bounds, Vec3 up);

}  // namespace chiaro
