// The Halton sequence (Halton and Weller, CACM 247, 1964; the paper's 3.2), rotated independently a
// replicate so that a few replicates give an honest variance.
#pragma once

#include "base/random.h"

#include <cstdint>

namespace chiaro {

/// Dimensions that halton() serves: the bases are the first kHaltonDimensions primes.
inline constexpr int kHaltonDimensions = 8;

/// Radical inverse of `index` in the base of `dimension` (0 to kHaltonDimensions - 1), in [0, 1).
/// Continues without end: a vertex that has taken n samples goes on with index n.
float halton(int dimension, std::uint32_t index);

/// `point` + `rotation` modulo 1 (Cranley and Patterson 1976): keeps the sequence's evenness, and
/// with a random rotation is an unbiased sample. Both in [0, 1).
inline float rotate_unit(float point, float rotation) {
    const float sum = point + rotation;
    return sum < 1.0f ? sum : sum - 1.0f;
}

}  // namespace chiaro
