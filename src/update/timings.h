// Where a cycle's time goes: the rows of the paper's Table 1.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace chiaro {

/// Wall time from `start` to now [s].
inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

enum class Step {
    sample_selection,   // ID map, priorities, selection
    patch_subdivision,  // dividing patches, handing fragments down
    tessellation,       // of curved surfaces
    aging,
    update_display_meshes,  // values carried from coarse to fine for display
    rendering,              // the sample renderer
};
inline constexpr std::size_t kSteps = 6;
inline constexpr std::array<const char*, kSteps> kStepNames = {
    "sample_selection",      "patch_subdivision", "tessellation", "aging",
    "update_display_meshes", "rendering"};

/// Seconds of wall time by step, over all cycles so far.
struct Timings {
    std::array<double, kSteps> seconds{};
    double nested = 0;  // of timers that ended within the one that runs

    double of(Step step) const { return seconds[static_cast<std::size_t>(step)]; }
    double total() const {
        double sum = 0;
        for (const double s : seconds) sum += s;
        return sum;
    }
};

/// Adds the time from its making to its end to one step, less what timers within it took.
class StepTimer {
public:
    StepTimer(Timings& timings, Step step)
        : timings_(timings), step_(step), outer_nested_(timings.nested), start_(Clock::now()) {
        timings.nested = 0;
    }
    ~StepTimer() {
        const double elapsed = seconds_since(start_);
        timings_.seconds[static_cast<std::size_t>(step_)] += elapsed - timings_.nested;
        timings_.nested = outer_nested_ + elapsed;
    }
    StepTimer(const StepTimer&) = delete;
    StepTimer& operator=(const StepTimer&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    Timings& timings_;
    Step step_;
    double outer_nested_;
    Clock::time_point start_;
};

}  // namespace chiaro
