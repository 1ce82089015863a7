#include "sample_renderer/shade_tasks.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr std::uint32_t kTaskSamples = 1024;  // a wave: large enough for packets, and cached
constexpr std::uint32_t kProbeRays = 16;
constexpr std::size_t kTasksPerBody = 8;

void add_tasks(std::uint32_t request, Light light, std::uint32_t first, std::uint32_t count,
               std::vector<Task>& tasks) {
    check(count > 0 && count % kReplicates == 0,
          "shade: samples must be a multiple of kReplicates");
    for (std::uint32_t done = 0; done < count; done += kTaskSamples)
        tasks.push_back(
            {request, light, first + done, std::min(kTaskSamples, count - done), done == 0});
}

// Means of the replicates, over all tasks of one request: direct and indirect light of one
// replicate go together.
ShadeResult combine_one(const ShadeRequest& request, std::span<const Task> tasks,
                        std::span<const TaskResult> parts) {
    std::array<glm::dvec3, kReplicates> means = {};
    glm::dvec3 exact(0);
    RayCount rays;
    double shared = 0;
    for (std::size_t t = 0; t < tasks.size(); ++t) {
        const bool second = request.light == Light::total && tasks[t].light == Light::indirect;
        const double share =
            kReplicates / double(second ? request.indirect_samples : request.samples);
        for (std::uint32_t r = 0; r < kReplicates; ++r)
            means[r] += share * glm::dvec3(parts[t].sums[r]);
        const double part = share / kReplicates;
        shared += part * part * parts[t].shared_variance;
        exact += parts[t].exact;
        rays.shot += parts[t].rays.shot;
        rays.inside += parts[t].rays.inside;
    }

    glm::dvec3 mean(0), squares(0);
    for (const glm::dvec3& m : means) mean += m / double(kReplicates);
    for (const glm::dvec3& m : means) squares += (m - mean) * (m - mean);
    ShadeResult result;
    result.mean = Rgb(mean + exact);
    result.variance = Rgb(squares / double(kReplicates * (kReplicates - 1)) + shared);
    result.buried = rays.mostly_inside();
    return result;
}

}  // namespace

std::vector<Task> split_into_tasks(std::span<const ShadeRequest> requests) {
    std::vector<Task> tasks;
    tasks.reserve(requests.size());
    for (std::uint32_t i = 0; i < requests.size(); ++i) {
        const ShadeRequest& r = requests[i];
        const Light first = r.light == Light::total ? Light::direct : r.light;
        add_tasks(i, first, r.first_sample, r.samples, tasks);
        if (r.light == Light::total) {
            const auto before = std::uint64_t{r.first_sample} * r.indirect_samples / r.samples;
            add_tasks(i, Light::indirect, static_cast<std::uint32_t>(before), r.indirect_samples,
                      tasks);
        }
    }
    return tasks;
}

Receiver request_receiver(const LitScene& lit, const ShadeRequest& request) {
    if (request.place) {
        const auto& [position, normal] = *request.place;
        return {position, position + RayCaster::offset(position) * normal, normal, normal};
    }
    const SurfaceGeometry g = surface_geometry(lit.scene, request.where);
    const float side = request.front ? 1.0f : -1.0f;
    return make_receiver(lit.caster, request.where.object, g.position, side * g.geometric_normal,
                         side * g.shading_normal);
}

SampleRun task_run(const Receiver& receiver, const Task& task, const ShadeRequest& request) {
    const std::uint32_t salt = task.light == Light::direct ? kDirectSalt : kIndirectSalt;
    return {receiver, hash32(request.seed, salt), task.first, task.count};
}

TaskResult run_direct(const LitScene& lit, const SampleRun& run, const Task& task,
                      PathWave& scratch) {
    TaskResult result;
    if (task.starts) add_exact_direct_light(lit, {&run, 1}, scratch, {&result.exact, 1});
    if (!direct_light_is_exact(lit)) add_direct_samples(lit, {&run, 1}, scratch, result.sums);
    return result;
}

TaskResult run_glossy(const LitScene& lit, const Task& task, const ShadeRequest& request,
                      PathWave& scratch, const EndsAt* ends_at) {
    TaskResult result;
    if (task.light == Light::glint)
        add_glint_samples(lit, request, task.first, task.count, scratch, result.sums);
    else
        add_glossy_samples(lit, request, task.first, task.count, scratch, result.sums, ends_at);
    return result;
}

void probe_if_dark(const LitScene& lit, const OpenSides* open_sides, const Receiver& receiver,
                   const Task& task, const ShadeRequest& request, PathWave& scratch,
                   TaskResult& result) {
    const bool asked = request.light == Light::direct || request.light == Light::glossy;
    if (!asked || open_sides == nullptr || !task.starts) return;
    Rgb total = result.exact;
    for (const Rgb& sum : result.sums) total += sum;
    if (total == Rgb(0))
        result.rays = probe(lit, *open_sides, receiver, hash32(request.seed, kDirectSalt),
                            kProbeRays, scratch);
}

void combine(std::span<const ShadeRequest> requests, std::span<const Task> tasks,
             std::span<const TaskResult> parts, std::span<ShadeResult> results) {
    for (std::size_t begin = 0; begin < tasks.size();) {
        const std::uint32_t request = tasks[begin].request;
        std::size_t end = begin;
        while (end < tasks.size() && tasks[end].request == request) ++end;
        results[request] = combine_one(requests[request], tasks.subspan(begin, end - begin),
                                       parts.subspan(begin, end - begin));
        begin = end;
    }
}

void shade_requests(const LitScene& lit, const OpenSides* open_sides, int threads,
                    std::span<const ShadeRequest> requests, std::span<ShadeResult> results,
                    const RunIndirect& run_indirect) {
    check(requests.size() == results.size(), "shade: one result a request");
    const std::vector<Task> tasks = split_into_tasks(requests);
    std::vector<TaskResult> parts(tasks.size());
    const std::size_t bodies = (tasks.size() + kTasksPerBody - 1) / kTasksPerBody;
    parallel_for(threads, bodies, [&](std::size_t body) {
        thread_local PathWave scratch;
        const std::size_t end = std::min(tasks.size(), (body + 1) * kTasksPerBody);
        for (std::size_t t = body * kTasksPerBody; t < end; ++t) {
            const ShadeRequest& request = requests[tasks[t].request];
            const Receiver receiver = request_receiver(lit, request);
            const SampleRun run = task_run(receiver, tasks[t], request);
            if (tasks[t].light == Light::direct)
                parts[t] = run_direct(lit, run, tasks[t], scratch);
            else if (tasks[t].light == Light::indirect)
                parts[t] = run_indirect(run, tasks[t], scratch);
            else
                parts[t] = run_glossy(lit, tasks[t], request, scratch);
            probe_if_dark(lit, open_sides, receiver, tasks[t], request, scratch, parts[t]);
        }
    });
    combine(requests, tasks, parts, results);
}

}  // namespace chiaro
