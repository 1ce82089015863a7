#include "base/weighted_choice.h"

#include "base/error.h"

#include <algorithm>

namespace chiaro {

WeightedChoice::WeightedChoice(std::span<const double> weights) {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    if (!(sum > 0)) return;
    up_to_.reserve(weights.size());
    double before = 0;
    for (const double weight : weights) up_to_.push_back((before += weight) / sum);
}

WeightedChoice::Choice WeightedChoice::choose(float u) const {
    check(!empty(), "WeightedChoice: nothing to choose");
    // The first whose sum is above u has a chance itself; rounding may leave u above all.
    auto found = std::upper_bound(up_to_.begin(), up_to_.end(), static_cast<double>(u));
    if (found == up_to_.end())
        found = std::lower_bound(up_to_.begin(), up_to_.end(), up_to_.back());
    const double before = found == up_to_.begin() ? 0.0 : *(found - 1);
    const double rest = (u - before) / (*found - before);
    return {static_cast<std::uint32_t>(found - up_to_.begin()), static_cast<float>(*found - before),
            std::clamp(static_cast<float>(rest), 0.0f, 0x1.fffffep-1f)};
}

float WeightedChoice::probability(std::uint32_t index) const {
    if (empty()) return 0;
    return static_cast<float>(up_to_[index] - (index == 0 ? 0.0 : up_to_[index - 1]));
}

}  // namespace chiaro
