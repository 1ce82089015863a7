// Priority maps whose numbers are known, without a cache.
#pragma once

#include "sample_selector/select_samples.h"

#include <vector>

namespace chiaro::tiny {

/// What one patch covers, and its priority.
struct Strip {
    std::uint32_t pixels;
    float priority;
};

/// Patches one after the other in rows `width` wide; the last row is filled up with background.
inline PriorityMap strips(const std::vector<Strip>& patches, int width) {
    PriorityMap map;
    map.width = width;
    std::uint32_t id = 0;
    for (const Strip& s : patches) {
        map.patches.insert(map.patches.end(), s.pixels, static_cast<PatchId>(id++));
        map.pixel_priorities.insert(map.pixel_priorities.end(), s.pixels, s.priority);
        map.patch_priorities.push_back(s.priority);
    }
    while (map.patches.size() % static_cast<std::size_t>(width) != 0) {
        map.patches.push_back(PatchId::none);
        map.pixel_priorities.push_back(0);
    }
    map.height = static_cast<int>(map.patches.size()) / width;
    return map;
}

/// Each pixel a patch of its own; a negative priority is background.
inline PriorityMap pixels(int width, const std::vector<float>& priorities) {
    PriorityMap map;
    map.width = width;
    map.height = static_cast<int>(priorities.size()) / width;
    map.pixel_priorities = priorities;
    for (std::uint32_t i = 0; i < priorities.size(); ++i) {
        map.patches.push_back(priorities[i] < 0 ? PatchId::none : static_cast<PatchId>(i));
        if (priorities[i] >= 0) map.patch_priorities.push_back(priorities[i]);
    }
    return map;
}

/// A selection, and how many pixels were tested for it: counted by the random numbers it took, two
/// a test on a map without background.
struct CountedSelection {
    std::vector<SelectedPixel> selected;
    std::size_t tests;
};
inline CountedSelection counted_hit_and_test(const PriorityMap& map, std::size_t count,
                                             float epsilon, std::uint64_t seed) {
    Rng used(seed);
    CountedSelection result = {hit_and_test(map, count, epsilon, used), 0};
    const std::uint32_t next = used.next(), after = used.next();
    Rng walk(seed);
    std::uint32_t a = walk.next(), b = walk.next();
    std::size_t draws = 0;
    for (; a != next || b != after; ++draws) {
        a = b;
        b = walk.next();
    }
    result.tests = draws / 2;
    return result;
}

}  // namespace chiaro::tiny
