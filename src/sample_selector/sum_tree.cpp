#include "sample_selector/sum_tree.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace chiaro {

void SumTree::resize(std::size_t count) {
    if (count == 0) return;
    if (levels_.empty()) levels_.emplace_back();
    for (std::size_t level = 0;; ++level) {
        auto& sums = levels_[level];
        if (sums.capacity() < count) sums.reserve(count + count / 8);
        sums.resize(count, 0.0f);
        if (count <= kFan) break;
        count = (count + kFan - 1) / kFan;
        if (level + 1 < levels_.size()) continue;
        // A new top level: its sums are of weights that are there already.
        std::vector<float> above(count, 0.0f);
        for (std::size_t i = 0; i < sums.size(); ++i) above[i / kFan] += sums[i];
        levels_.push_back(std::move(above));
    }
}

void SumTree::assign(std::vector<float> weights) {
    for (const float w : weights)
        check(w >= 0 && std::isfinite(w), "SumTree: weights are finite and not negative");
    levels_.clear();
    if (weights.empty()) return;
    levels_.push_back(std::move(weights));
    while (levels_.back().size() > kFan) {
        const auto& below = levels_.back();
        std::vector<float> above((below.size() + kFan - 1) / kFan, 0.0f);
        for (std::size_t i = 0; i < below.size(); ++i) above[i / kFan] += below[i];
        levels_.push_back(std::move(above));
    }
}

void SumTree::set(std::size_t i, float weight) {
    check(weight >= 0 && std::isfinite(weight), "SumTree: weights are finite and not negative");
    levels_.front()[i] = weight;
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const auto& below = levels_[level - 1];
        const std::size_t first = i / kFan * kFan;
        const std::size_t last = std::min(first + kFan, below.size());
        float sum = 0;
        for (std::size_t k = first; k < last; ++k) sum += below[k];
        i /= kFan;
        levels_[level][i] = sum;
    }
}

double SumTree::total() const {
    double sum = 0;
    if (!levels_.empty())
        for (const float w : levels_.back()) sum += w;
    return sum;
}

std::size_t SumTree::draw(float u) const {
    check(total() > 0, "SumTree: nothing to draw");
    double rest = u * total();
    std::size_t first = 0;
    for (std::size_t level = levels_.size(); level-- > 0;) {
        const auto& sums = levels_[level];
        const std::size_t last =
            level + 1 == levels_.size() ? sums.size() : std::min(first + kFan, sums.size());
        // Rounding may carry `rest` past the end: the last positive weight then stands for it.
        std::size_t chosen = first;
        for (std::size_t k = first; k < last; ++k) {
            if (!(sums[k] > 0)) continue;
            chosen = k;
            if (rest < sums[k]) break;
            rest -= sums[k];
        }
        first = level == 0 ? chosen : chosen * kFan;
    }
    return first;
}

std::size_t SumTree::bytes() const {
    std::size_t total = 0;
    for (const auto& level : levels_) total += level.capacity() * sizeof(float);
    return total;
}

}  // namespace chiaro
