#include "sample_selector/sum_tree.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// The entry of [first, last) in which `rest` ends, less what comes before it. Rounding may carry
// `rest` past the end: the last positive entry then stands for it.
template <typename Sums>
std::size_t pick(const Sums& sums, std::size_t first, std::size_t last, double& rest) {
    std::size_t chosen = first;
    for (std::size_t k = first; k < last; ++k) {
        const auto weight = static_cast<double>(static_cast<float>(sums[k]));
        if (!(weight > 0)) continue;
        chosen = k;
        if (rest < weight) break;
        rest -= weight;
    }
    return chosen;
}

}  // namespace

template <typename Below>
float SumTree::sum_of(const Below& below, std::size_t parent) {
    const std::size_t last = std::min((parent + 1) * kFan, below.size());
    float sum = 0;
    for (std::size_t k = parent * kFan; k < last; ++k) sum += below[k];
    return sum;
}

void SumTree::clear() {
    weights_.clear();
    sums_.clear();
}

void SumTree::resize(std::size_t count) {
    if (weights_.capacity() < count) weights_.reserve(count + count / 64 + 64);
    weights_.resize(std::max(count, weights_.size()));
    std::size_t below = weights_.size();
    for (std::size_t level = 0; below > 1; ++level) {
        below = (below + kFan - 1) / kFan;
        if (level < sums_.size()) {
            sums_[level].resize(below, 0.0f);
            continue;
        }
        // A new top level: its sums are of weights that are there already.
        sums_.emplace_back(below);
        for (std::size_t i = 0; i < below; ++i) add_up(level, i);
    }
}

void SumTree::put(std::size_t i, float weight) {
    check(weight >= 0 && std::isfinite(weight), "SumTree: weights are finite and not negative");
    weights_[i] = weight;
}

void SumTree::add_up(std::size_t level, std::size_t parent) {
    sums_[level][parent] = level == 0 ? sum_of(weights_, parent) : sum_of(sums_[level - 1], parent);
}

void SumTree::assign(std::span<const float> weights) {
    clear();
    weights_.resize(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i) put(i, weights[i]);
    resize(weights_.size());
}

void SumTree::set(std::size_t i, float weight) {
    put(i, weight);
    for (std::size_t level = 0; level < sums_.size(); ++level) add_up(level, i /= kFan);
}

void SumTree::set_many(std::span<const std::uint32_t> indices, std::span<const float> weights) {
    for (std::size_t k = 0; k < indices.size(); ++k) put(indices[k], weights[k]);
    std::size_t below = 1;  // weights under a sum of this level
    for (std::size_t level = 0; level < sums_.size(); ++level) {
        below *= kFan;
        for (std::size_t k = 0; k < indices.size(); ++k)
            if (k == 0 || indices[k] / below != indices[k - 1] / below)
                add_up(level, indices[k] / below);
    }
}

double SumTree::total() const {
    if (!sums_.empty()) return sums_.back().front();
    return weights_.empty() ? 0.0 : static_cast<float>(weights_.front());
}

std::size_t SumTree::draw(float u) const {
    check(total() > 0, "SumTree: nothing to draw");
    double rest = u * total();
    std::size_t first = 0;
    for (std::size_t level = sums_.size(); level-- > 0;) {
        const std::size_t last = std::min(first + kFan, sums_[level].size());
        first = pick(sums_[level], first, last, rest) * kFan;
    }
    return pick(weights_, first, std::min(first + kFan, weights_.size()), rest);
}

std::size_t SumTree::bytes() const {
    std::size_t total = weights_.capacity() * sizeof(Bfloat16);
    for (const auto& level : sums_) total += level.capacity() * sizeof(float);
    return total;
}

}  // namespace chiaro
