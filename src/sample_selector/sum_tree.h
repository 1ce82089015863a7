// Random choice in proportion to a weight, where weights change one at a time.
#pragma once

#include <cstddef>
#include <vector>

namespace chiaro {

/// Non-negative weights by index, with their sums in a tree of fan-out 16: setting one and drawing
/// one both cost a few cache lines, however many there are; 4.3 bytes a weight. Sums are always made
/// anew from their parts, so that no rounding error gathers.
class SumTree {
public:
    /// Grows with weights of 0; never shrinks except by clear().
    void resize(std::size_t count);
    void clear() { levels_.clear(); }
    std::size_t size() const { return levels_.empty() ? 0 : levels_.front().size(); }

    /// Sets all weights at once: as resize() and set() for each, but in one pass.
    void assign(std::vector<float> weights);

    float weight(std::size_t i) const { return levels_.front()[i]; }
    void set(std::size_t i, float weight);
    double total() const;

    /// The index at which the running sum of weights passes u * total(); u in [0, 1). Checks that
    /// some weight is positive.
    std::size_t draw(float u) const;

    std::size_t bytes() const;

private:
    static constexpr std::size_t kFan = 16;
    std::vector<std::vector<float>> levels_;  // [0] the weights, each further level sums of kFan
};

}  // namespace chiaro
