// Random choice in proportion to a weight, where weights change one at a time.
#pragma once

#include "base/bfloat16.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace chiaro {

/// Non-negative weights by index, with their sums in a tree of fan-out 16: setting one and drawing
/// one both cost a few cache lines, however many there are; 2.3 bytes a weight, kept to 8 bits.
/// Sums are always made anew from their parts, so that no rounding error gathers.
class SumTree {
public:
    /// Grows with weights of 0; never shrinks except by clear().
    void resize(std::size_t count);
    void clear();
    std::size_t size() const { return weights_.size(); }

    /// Sets all weights at once: as resize() and set() for each, but in one pass.
    void assign(std::span<const float> weights);

    float weight(std::size_t i) const { return weights_[i]; }
    void set(std::size_t i, float weight);
    /// Sets many at once, each sum being made once: weights[k] at indices[k], in ascending order.
    void set_many(std::span<const std::uint32_t> indices, std::span<const float> weights);
    double total() const;

    /// The index at which the running sum of weights passes u * total(); u in [0, 1). Checks that
    /// some weight is positive.
    std::size_t draw(float u) const;

    std::size_t bytes() const;

private:
    static constexpr std::size_t kFan = 16;
    template <typename Below>
    static float sum_of(const Below& below, std::size_t parent);
    void put(std::size_t i, float weight);
    void add_up(std::size_t level, std::size_t parent);

    std::vector<Bfloat16> weights_;
    std::vector<std::vector<float>> sums_;  // each entry of kFan below it; [0] of weights
};

}  // namespace chiaro
