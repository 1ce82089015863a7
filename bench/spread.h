// Repeated measurements in short.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace chiaro {

/// Median, lowest and highest of at least one value.
inline nlohmann::ordered_json spread_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return {{"median", values[(values.size() - 1) / 2]},
            {"low", values.front()},
            {"high", values.back()}};
}

}  // namespace chiaro
