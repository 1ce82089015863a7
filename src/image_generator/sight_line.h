// Where rays from the eye went.
#pragma once

#include "base/vec.h"

#include <cstdint>

namespace chiaro {

/// A ray's way from where it starts to what hides all behind it; far beyond the scene if nothing
/// does.
struct SightLine {
    std::uint32_t x;  // pixel in the row
    Vec3 from, to;    // world space
};

}  // namespace chiaro
