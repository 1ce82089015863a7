#include "base/halton.h"

#include "base/error.h"

#include <array>
#include <vector>

namespace chiaro {
namespace {

constexpr std::array<std::uint32_t, kHaltonDimensions> kPrimes = {2, 3, 5, 7, 11, 13, 17, 19};
constexpr std::uint32_t kTableSize = 4096;
constexpr float kBelowOne = 0x1.fffffep-1f;

float radical_inverse(std::uint32_t base, std::uint32_t index) {
    // In double: the digits of an index of 32 bits do not fit a float's mantissa.
    const double inverse_base = 1.0 / base;
    double scale = inverse_base;
    double value = 0;
    for (; index > 0; index /= base, scale *= inverse_base) value += (index % base) * scale;
    return value < kBelowOne ? static_cast<float>(value) : kBelowOne;
}

// The first indices of every dimension: nearly all look-ups, and 20 times cheaper than the digits.
std::vector<float> make_table() {
    std::vector<float> table(kHaltonDimensions * kTableSize);
    for (int d = 0; d < kHaltonDimensions; ++d)
        for (std::uint32_t i = 0; i < kTableSize; ++i)
            table[d * kTableSize + i] = radical_inverse(kPrimes[d], i);
    return table;
}

}  // namespace

float halton(int dimension, std::uint32_t index) {
    static const std::vector<float> table = make_table();
    check(dimension >= 0 && dimension < kHaltonDimensions, "halton: dimension out of range");
    if (index < kTableSize) return table[dimension * kTableSize + index];
    return radical_inverse(kPrimes[dimension], index);
}

}  // namespace chiaro
