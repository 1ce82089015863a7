// Sorting by all threads.
#pragma once

#include <cstdint>
#include <span>

namespace chiaro {

/// What is sorted, and by what.
struct KeyedIndex {
    std::uint64_t key;
    std::uint32_t index;
};

/// Sorts by key and, where keys agree, by index, on up to `threads` threads.
void parallel_sort(int threads, std::span<KeyedIndex> entries);

}  // namespace chiaro
