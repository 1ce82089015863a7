// A choice of one of many by fixed weights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace chiaro {

/// Thread: const calls from any number of threads.
class WeightedChoice {
public:
    WeightedChoice() = default;
    /// Weights are finite and at least 0. Where none is above 0, nothing can be chosen.
    explicit WeightedChoice(std::span<const double> weights);

    struct Choice {
        std::uint32_t index;
        float probability;  // > 0
        float rest;         // of the number: uniform in [0, 1) again
    };
    /// `u` in [0, 1). Checks: some weight is above 0.
    Choice choose(float u) const;
    /// Of this index; 0 where its weight is.
    float probability(std::uint32_t index) const;
    bool empty() const { return up_to_.empty(); }

private:
    std::vector<double> up_to_;  // sum of the chances up to an index, itself included
};

}  // namespace chiaro
