// Textures computed: what paints them.
#pragma once

#include "scene/texture.h"

#include <cstdint>
#include <functional>
#include <string>

namespace chiaro {

/// Linear reflectance at (u, v) in [0, 1).
using Paint = std::function<Rgb(float u, float v)>;

/// `samples` x `samples` to a texel: 1 where the paint is smooth, 2 keeps hard edges from stepping.
Texture painted(std::string name, int width, int height, int samples, const Paint& paint);

/// Unlike numbers in [0, 1) for the points of a lattice.
float lattice_value(int x, int y, std::uint32_t seed);

/// Smooth noise in [0, 1] with `columns` x `rows` cells to the unit square, which it tiles.
float tiling_noise(float u, float v, int columns, int rows, std::uint32_t seed);

/// Fibres of wood along u: long soft streaks over fine ones, in [0, 1].
float wood_figure(float u, float v, std::uint32_t seed);

}  // namespace chiaro
