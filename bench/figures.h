// What measuring programs take down: time, memory, the size of scenes.
#pragma once

#include "scene/scene.h"

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ctime>

namespace chiaro {

/// Wall time [s] since it was made or last restarted.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    void restart() { start_ = Clock::now(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// The processor's time [s] spent on all threads of the program, or on the calling thread alone.
inline double processor_seconds(clockid_t of = CLOCK_PROCESS_CPUTIME_ID) {
    timespec t = {};
    clock_gettime(of, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
inline double thread_seconds() {
    return processor_seconds(CLOCK_THREAD_CPUTIME_ID);
}

/// Bytes of the program that are in memory, once what is free has been given back; 0 where the
/// system does not tell.
inline std::size_t resident_bytes() {
    malloc_trim(0);
    std::size_t all = 0, resident = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%zu %zu", &all, &resident) != 2) resident = 0;
        std::fclose(file);
    }
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Triangles that the scene's objects show; a quad is two.
inline std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Object& object : scene.objects)
        if (object.mesh != MeshId::none)
            count += scene.mesh_of(object).primitives.size() + scene.mesh_of(object).quad_count;
    return count;
}

}  // namespace chiaro
