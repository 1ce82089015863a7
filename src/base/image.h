// A picture in memory. Files are read and written by import/image_file.h.
#pragma once

#include "base/color.h"
#include "base/error.h"

#include <vector>

namespace chiaro {

/// Linear RGB pixels in rows from the top, x to the right. Values are radiance, irradiance or an
/// encoded picture in [0, 1], as the owner says.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, Rgb(0)) {}

    Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
    const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace chiaro
