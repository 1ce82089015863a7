#include "sample_renderer/gather_renderer.h"

#include "base/error.h"
#include "base/parallel.h"
#include "sample_renderer/shade_tasks.h"

#include <algorithm>
#include <bit>

namespace chiaro {
namespace {

// Samples between two updates of the cells.
constexpr std::uint32_t kBatchSamples = 16384;

// One in so many rays that end in a cell is noted, and stands for all of them. (By chance alone:
// were cells that seem bright filled more, those that seem dark by bad luck would stay so.)
constexpr float kRaysANote = 8;

// One in so many samples also aims at what is bright.
constexpr std::uint32_t kSamplesAnAimedRay = 8;

// What of one request's estimate hangs on each cell: errors of a cell are common to all rays that
// end in it.
class CellShares {
public:
    /// Room for as many cells as `rays` may end in; a path that goes on from glossy surfaces may
    /// end in several, for which more is made.
    void reset(std::uint32_t rays) {
        count_ = 0;
        const std::size_t slots = std::bit_ceil(2 * std::size_t{rays});
        ids_.assign(slots, CellId::none);
        shares_.assign(slots, 0.0f);
    }
    void add(CellId id, float share) {
        const std::size_t slot = find(id);
        if (ids_[slot] == CellId::none && 2 * ++count_ > ids_.size()) {
            grow();
            add(id, share);
            return;
        }
        ids_[slot] = id;
        shares_[slot] += share;
    }
    // Variance of the sum of shares times the cells' luminance.
    double variance(const IrradianceCells& cells) const {
        double sum = 0;
        for (std::size_t i = 0; i < ids_.size(); ++i)
            if (ids_[i] != CellId::none)
                sum += double(shares_[i]) * shares_[i] * cells.cell(ids_[i]).variance();
        return sum;
    }

private:
    std::size_t find(CellId id) const {
        for (std::size_t i = index_of(id) * 0x9e3779b1u >> 7;; ++i) {
            i &= ids_.size() - 1;
            if (ids_[i] == id || ids_[i] == CellId::none) return i;
        }
    }
    void grow() {
        const std::vector<CellId> ids = std::move(ids_);
        const std::vector<float> shares = std::move(shares_);
        reset(static_cast<std::uint32_t>(ids.size()));
        for (std::size_t i = 0; i < ids.size(); ++i)
            if (ids[i] != CellId::none) add(ids[i], shares[i]);
    }

    std::size_t count_ = 0;
    std::vector<CellId> ids_;  // open addressing, at most half full
    std::vector<float> shares_;
};

struct Scratch {
    PathWave wave;
    CellShares shares;
};

// Rays that were aimed tell nothing of where in a cell rays end, which it is the mean of: they
// would fill it at what is bright in it alone.
bool takes_note(const Path& path, std::uint32_t bounce) {
    if (path.first == Path::kAimedFirst) return false;
    constexpr std::uint32_t kNoteSalt = 0x907e;
    return BounceNumbers(hash32(path.key, kNoteSalt), bounce).next() * kRaysANote < 1;
}

// The indirect part of a request, or a glossy request, by rays that end in cells; appends to
// `asking`.
TaskResult gather(const LitScene& lit, IndirectOptions options, const IrradianceCells& cells,
                  const SampleRun& run, const Task& task, const ShadeRequest& request,
                  Scratch& scratch, std::vector<Asking>& asking) {
    scratch.shares.reset(task.count);
    TaskResult result;
    std::array<Rgb, kReplicates> ended = {};
    const EndsAt ends_at = [&](const Meetings& met) {
        CellFound found[kLanes];
        std::uint32_t here = 0;
        const Lanes3 reflected(met.reflected);
        for_each_lane(find_cells(cells, met, found), [&](int i) {
            const auto [id, wants] = found[i];
            const Path& path = met.paths[i];
            const bool wanting = id == CellId::none || cells.cell(id).key != wants;
            if (wanting && path.first != Path::kAimedFirst)
                asking.push_back({wants, 1, lane(met.met, i)});
            else if (takes_note(path, met.bounce))
                asking.push_back({wants, kRaysANote, lane(met.met, i)});
            if (id == CellId::none) return;
            here |= 1U << i;
            const Rgb weight = reflected.lane(i) * (1 / kPi);
            ended[path.slot] += weight * cells.cell(id).mean;
            scratch.shares.add(id, luminance(weight));
        });
        return here;
    };
    options.ends_at = &ends_at;
    float scale = 1;
    if (task.light == Light::indirect) {
        scale = kPi;
        result.rays = add_indirect_samples(lit, {&run, 1}, scratch.wave, result.sums, options);
    } else {
        result = run_glossy(lit, task, request, scratch.wave, &ends_at);
    }
    for (std::uint32_t r = 0; r < kReplicates; ++r) result.sums[r] += scale * ended[r];
    result.shared_variance = scale * scale * scratch.shares.variance(cells);
    return result;
}

}  // namespace

GatherRenderer::GatherRenderer(const Scene& scene, const RayCaster& caster,
                               const AreaLights& area_lights, const OpenSides* open_sides,
                               int threads, std::uint32_t seed)
    : lit_(make_lit_scene(scene, caster, area_lights)),
      open_sides_(open_sides),
      threads_(threads),
      seed_(seed),
      bright_(bright_surfaces(lit_, threads)),
      cells_(make_cell_grid(bounds(scene))) {}

SampleCosts GatherRenderer::typical_costs() const {
    return {.direct = 0.12e-6f, .indirect = 0.6e-6f};
}

void GatherRenderer::shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) {
    check(requests.size() == results.size(), "shade: one result a request");
    const std::vector<Task> tasks = split_into_tasks(requests);
    std::vector<TaskResult> parts(tasks.size());
    const Aims aims = {bright_, kSamplesAnAimedRay};
    const IndirectOptions options = {.open_sides = open_sides_,
                                     .aims = bright_.empty() ? nullptr : &aims};

    for (std::size_t begin = 0; begin < tasks.size();) {
        // A batch of tasks against the cells as they are.
        std::size_t end = begin;
        for (std::uint32_t samples = 0; end < tasks.size() && samples < kBatchSamples; ++end)
            samples += tasks[end].light == Light::direct ? 0 : tasks[end].count;
        asked_.resize(std::max(asked_.size(), end - begin));
        parallel_for(threads_, end - begin, [&](std::size_t i) {
            thread_local Scratch scratch;
            const Task& task = tasks[begin + i];
            const ShadeRequest& request = requests[task.request];
            const Receiver receiver = request_receiver(lit_, request);
            const SampleRun run = task_run(receiver, task, request);
            TaskResult& part = parts[begin + i];
            part = task.light == Light::direct
                       ? run_direct(lit_, run, task, scratch.wave)
                       : gather(lit_, options, cells_, run, task, request, scratch, asked_[i]);
            probe_if_dark(lit_, open_sides_, receiver, task, request, scratch.wave, part);
        });

        // What it asked for, in the order of tasks.
        asking_.clear();
        for (std::vector<Asking>& some : std::span(asked_).first(end - begin)) {
            asking_.insert(asking_.end(), some.begin(), some.end());
            some.clear();
        }
        fill_cells(lit_, options.aims, threads_, seed_, cells_, asking_);
        begin = end;
    }
    combine(requests, tasks, parts, results);
}

}  // namespace chiaro
