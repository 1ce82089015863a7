// Which samples of light at which place; estimates of many runs go through one wave.
#pragma once

#include "sample_renderer/receiver.h"
#include "sample_renderer/sample_renderer.h"

namespace chiaro {

/// Samples [first, first + count) of the sequence that `seed` names, of light at one place.
///
/// Where there are several runs, run r adds to sums [kReplicates * r, kReplicates * (r + 1)):
/// sample i to that of replicate i % kReplicates.
struct SampleRun {
    Receiver receiver;
    std::uint32_t seed, first, count;
};

/// The sum of the run at `index` that `sample` adds to.
inline std::uint32_t slot_of(std::size_t index, std::uint32_t sample) {
    return kReplicates * static_cast<std::uint32_t>(index) + sample % kReplicates;
}
/// The run that a sum belongs to.
inline const SampleRun& run_of(std::span<const SampleRun> runs, std::uint32_t slot) {
    return runs[slot / kReplicates];
}

}  // namespace chiaro
