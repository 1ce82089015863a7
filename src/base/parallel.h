// Loops over threads. One thread runs the same code as a plain loop.
#pragma once

#include <cstddef>
#include <functional>

namespace chiaro {

/// Number of threads that the machine runs at once (at least 1).
int hardware_threads();

/// Calls body(i) for i in [0, count), on up to `threads` threads, in no promised order; returns
/// when all are done. Bodies write to places of their own, so that the result does not depend on
/// `threads`. Denormals are flushed to zero in the body on every thread.
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body);

/// A run of consecutive indices, [begin, end), and its number.
struct IndexRange {
    std::size_t begin, end, number;
};

/// Cuts [0, count) into ceil(count / size) ranges of `size`, the last one of what is left, and
/// calls body(range) for each as parallel_for() does. The ranges do not depend on `threads`.
void parallel_for_ranges(int threads, std::size_t count, std::size_t size,
                         const std::function<void(IndexRange)>& body);

}  // namespace chiaro
