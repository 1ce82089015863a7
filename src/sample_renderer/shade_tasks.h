// Requests cut into pieces that threads may take in any order, and put together again; shared by
// all renderers.
#pragma once

#include "sample_renderer/direct_light.h"
#include "sample_renderer/glossy_light.h"
#include "sample_renderer/indirect_light.h"

#include <functional>

namespace chiaro {

// Independent numbers for the two parts of `total`, whose replicates would else vary together.
inline constexpr std::uint32_t kDirectSalt = 0xd12ec7;
inline constexpr std::uint32_t kIndirectSalt = 0x1d12ec7;

/// A piece of a request that is computed by itself, so that neither batch nor threads show in it.
struct Task {
    std::uint32_t request;
    Light light;  // never `total`, which has direct and indirect tasks
    std::uint32_t first, count;
    bool starts;  // the first piece of its part of the request
};

struct TaskResult {
    std::array<Rgb, kReplicates> sums = {};
    Rgb exact = Rgb(0);
    RayCount rays;
    double shared_variance = 0;  // of the sum's luminance, by errors that all replicates share
};

/// In the order of requests. Checks: samples are multiples of kReplicates.
std::vector<Task> split_into_tasks(std::span<const ShadeRequest> requests);

/// Where a request receives light.
Receiver request_receiver(const LitScene& lit, const ShadeRequest& request);

/// The samples of a task of a request for direct or indirect light.
SampleRun task_run(const Receiver& receiver, const Task& task, const ShadeRequest& request);

/// The direct part of a request, by light samples.
TaskResult run_direct(const LitScene& lit, const SampleRun& run, const Task& task,
                      PathWave& scratch);

/// A request for light by way of glossy surfaces. What paths end at early is not added here.
TaskResult run_glossy(const LitScene& lit, const Task& task, const ShadeRequest& request,
                      PathWave& scratch, const EndsAt* ends_at = nullptr);

/// A point in the dark may be buried; one that some light reaches is not: looks around where direct
/// or glossy light was asked for and not found. `open_sides` may be null.
void probe_if_dark(const LitScene& lit, const OpenSides* open_sides, const Receiver& receiver,
                   const Task& task, const ShadeRequest& request, PathWave& scratch,
                   TaskResult& result);

/// Computes the indirect part of a request.
using RunIndirect =
    std::function<TaskResult(const SampleRun& run, const Task& task, PathWave& scratch)>;

/// All of shade() for renderers whose tasks are independent. `open_sides` may be null.
void shade_requests(const LitScene& lit, const OpenSides* open_sides, int threads,
                    std::span<const ShadeRequest> requests, std::span<ShadeResult> results,
                    const RunIndirect& run_indirect);

/// One result a request, from all of its parts.
void combine(std::span<const ShadeRequest> requests, std::span<const Task> tasks,
             std::span<const TaskResult> parts, std::span<ShadeResult> results);

}  // namespace chiaro
