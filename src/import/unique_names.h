// Names by which edits name objects, lights, cameras and materials.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace chiaro {

/// Gives out names that are all different: a second "Lamp" becomes "Lamp.2".
class UniqueNames {
public:
    /// `wanted`, or "`kind` N" counted from 1 when it is empty, made different from all before.
    std::string operator()(const std::string& wanted, const std::string& kind) {
        const std::string base = wanted.empty() ? kind + " " + std::to_string(++unnamed_) : wanted;
        std::string name = base;
        std::uint64_t& last = last_suffix_[base];
        while (!taken_.insert(name).second) {
            last = std::max<std::uint64_t>(last + 1, 2);
            name = base + "." + std::to_string(last);
        }
        return name;
    }

private:
    std::uint64_t unnamed_ = 0;
    std::unordered_map<std::string, std::uint64_t> last_suffix_;
    std::unordered_set<std::string> taken_;
};

}  // namespace chiaro
