// Numbers for what comes again.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace chiaro {

/// Gives equal keys equal numbers, from 0, in the order in which they first come.
template <typename Key>
struct Numbers {
    std::map<Key, std::uint32_t> of;
    std::vector<Key> used;  // by number

    std::uint32_t operator()(const Key& key) {
        const auto [known, fresh] = of.try_emplace(key, static_cast<std::uint32_t>(used.size()));
        if (fresh) used.push_back(key);
        return known->second;
    }
};

}  // namespace chiaro
