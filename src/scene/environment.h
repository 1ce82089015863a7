// Light from all around the scene, infinitely far away: a map of it, or one radiance everywhere.
#pragma once

#include "base/image.h"

namespace chiaro {

/// The map is equirectangular: the picture's height is the angle from the zenith, its width the way
/// round (EnvironmentFrame). It may have any size.
struct Environment {
    Rgb sky = Rgb(0);  // radiance of all directions where there is no map [cd/m2 a channel]
    Image map;         // radiance [cd/m2 a channel], finite and not negative; no pixels: none

    bool has_map() const { return !map.pixels.empty(); }
};

/// True if no light comes from it.
bool is_dark(const Environment& environment);

/// The mean over all directions [cd/m2 a channel].
Rgb mean_radiance(const Environment& environment);

/// How a map lies in the world. Its top row is at the vertical. Its middle is along +x, made level,
/// or along +y where +x is the vertical; from there to the right in the picture is to the right of
/// someone who stands upright and looks there. So it is in Blender (+x, where z is up) and in
/// viewers of glTF (+x, where y is up).
struct EnvironmentFrame {
    Vec3 middle, right, up;  // unit, perpendicular

    /// `up` is the world's vertical, of any length above 0.
    explicit EnvironmentFrame(Vec3 up);

    /// (u, v) in the picture, both in [0, 1], of a direction of any length above 0.
    Vec2 place_of(Vec3 direction) const;
    /// The unit direction of (u, v).
    Vec3 direction_of(Vec2 place) const;
};

/// The part of a map between the centres of four neighbouring pixels, of columns `column` and the
/// next, rows `row` and the next; both from -1 to one less than the map's size. Beyond the right
/// column is the left one; above the top row and below the bottom row they are repeated.
struct MapCell {
    int column, row;
};

/// A place in a map; `within` its cell, in [0, 1]. Maps are bilinear there.
struct MapPlace {
    MapCell cell;
    Vec2 within;
};
/// Of (u, v), both in [0, 1].
MapPlace place_in(const Image& map, Vec2 place);

/// A map's pixels at the corners of a cell.
struct CellCorners {
    const Rgb &left_top, &right_top, &left_bottom, &right_bottom;
};
CellCorners corners_of(const Image& map, MapCell cell);

template <typename Value>
Value interpolate(const Value& left_top, const Value& right_top, const Value& left_bottom,
                  const Value& right_bottom, Vec2 within) {
    const Value above = left_top + (right_top - left_top) * within.x;
    const Value below = left_bottom + (right_bottom - left_bottom) * within.x;
    return above + (below - above) * within.y;
}

/// Radiance that comes from `direction`, of any length above 0 [cd/m2 a channel].
Rgb radiance_from(const Environment& environment, const EnvironmentFrame& frame, Vec3 direction);

}  // namespace chiaro
