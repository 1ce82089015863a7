#include "sample_renderer/path_renderer.h"

#include "base/error.h"
#include "base/parallel.h"
#include "sample_renderer/shade_tasks.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr std::size_t kTasksPerBody = 8;

TaskResult run_indirect(const LitScene& lit, const OpenSides* open_sides, const Receiver& receiver,
                        const Task& task, const ShadeRequest& request, PathWave& scratch) {
    TaskResult result;
    result.rays =
        add_indirect_samples(lit, open_sides, receiver, hash32(request.seed, kIndirectSalt),
                             task.first, task.count, scratch, result.sums);
    return result;
}

// Shades the requests, whose receivers `receiver_of` gives by index.
template <typename ReceiverOf>
void shade_receivers(const LitScene& lit, const OpenSides* open_sides, int threads,
                     std::span<const ShadeRequest> requests, std::span<ShadeResult> results,
                     const ReceiverOf& receiver_of) {
    check(requests.size() == results.size(), "shade: one result a request");
    const std::vector<Task> tasks = split_into_tasks(requests);
    std::vector<TaskResult> parts(tasks.size());

    const std::size_t bodies = (tasks.size() + kTasksPerBody - 1) / kTasksPerBody;
    parallel_for(threads, bodies, [&](std::size_t body) {
        thread_local PathWave scratch;
        const std::size_t end = std::min(tasks.size(), (body + 1) * kTasksPerBody);
        for (std::size_t t = body * kTasksPerBody; t < end; ++t) {
            const std::uint32_t request = tasks[t].request;
            const auto run = tasks[t].direct ? run_direct : run_indirect;
            parts[t] =
                run(lit, open_sides, receiver_of(request), tasks[t], requests[request], scratch);
        }
    });

    combine(requests, tasks, parts, results);
}

}  // namespace

PathRenderer::PathRenderer(const Scene& scene, const RayCaster& caster,
                           const AreaLights& area_lights, const OpenSides* open_sides, int threads)
    : lit_(make_lit_scene(scene, caster, area_lights)),
      open_sides_(open_sides),
      threads_(threads) {}

SampleCosts PathRenderer::typical_costs() const {
    return {.direct = 0.12e-6f, .indirect = 0.9e-6f};
}

void PathRenderer::shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) {
    shade_receivers(lit_, open_sides_, threads_, requests, results,
                    [&](std::size_t i) { return surface_receiver(lit_, requests[i]); });
}

void shade_places(const LitScene& lit, std::span<const MeterPlace> places,
                  std::span<const ShadeRequest> requests, int threads,
                  std::span<ShadeResult> results) {
    check(places.size() == requests.size(), "shade_places: one place a request");
    shade_receivers(lit, nullptr, threads, requests, results, [&](std::size_t i) {
        const auto& [position, normal] = places[i];
        return Receiver{position, position + RayCaster::offset(position) * normal, normal, normal};
    });
}

}  // namespace chiaro
