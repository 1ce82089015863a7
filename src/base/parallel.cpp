#include "base/parallel.h"

#include <pmmintrin.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <algorithm>
#include <thread>

// TBB's library is not instrumented, so ThreadSanitizer cannot see that it orders the fork before
// the bodies and the bodies before the join: we say so.
#if defined(__SANITIZE_THREAD__)
#define CHIARO_TSAN 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CHIARO_TSAN 1
#endif
#endif
#ifdef CHIARO_TSAN
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#else
static void __tsan_acquire(void*) {}
static void __tsan_release(void*) {}
#endif

namespace chiaro {
namespace {

// Denormals cost a hundred cycles an operation and never matter here; the mode is a thread's own.
struct FlushDenormals {
    unsigned saved = _mm_getcsr();
    FlushDenormals() {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~FlushDenormals() { _mm_setcsr(saved); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;
};

}  // namespace

int hardware_threads() {
    return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body) {
    if (threads <= 1 || count <= 1) {
        const FlushDenormals mode;
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
    char fork = 0;
    char join = 0;
    __tsan_release(&fork);
    tbb::task_arena arena(threads);
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
            __tsan_acquire(&fork);
            const FlushDenormals mode;
            body(i);
            __tsan_release(&join);
        });
    });
    __tsan_acquire(&join);
}

void parallel_for_ranges(int threads, std::size_t count, std::size_t size,
                         const std::function<void(IndexRange)>& body) {
    parallel_for(threads, (count + size - 1) / size, [&](std::size_t number) {
        const std::size_t begin = number * size;
        body({begin, std::min(begin + size, count), number});
    });
}

}  // namespace chiaro
