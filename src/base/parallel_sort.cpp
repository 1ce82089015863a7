#include "base/parallel_sort.h"

#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace chiaro {

void parallel_sort(int threads, std::span<KeyedIndex> entries) {
    const auto before = [](const KeyedIndex& a, const KeyedIndex& b) {
        return a.key != b.key ? a.key < b.key : a.index < b.index;
    };
    if (threads <= 1) return std::sort(entries.begin(), entries.end(), before);
    tbb::task_arena arena(threads);
    arena.execute([&] { tbb::parallel_sort(entries.begin(), entries.end(), before); });
}

}  // namespace chiaro
