#include "sample_renderer/gather_renderer.h"

#include "base/error.h"
#include "base/parallel.h"
#include "sample_renderer/direct_light.h"
#include "sample_renderer/indirect_light.h"
#include "sample_renderer/shade_tasks.h"

#include <algorithm>
#include <bit>

namespace chiaro {
namespace {

// Samples between two updates of the cells.
constexpr std::uint32_t kBatchSamples = 16384;

// A cell is filled once this many rays have asked for it: about as many paths as filling it costs.
constexpr float kAskedBeforeFilled = 8;

// One unit of filling: this many direct samples and as many traced paths from one place.
constexpr std::uint32_t kSamplesAUnit = 4;
constexpr std::uint32_t kFirstUnits = 2;
constexpr std::uint32_t kMostUnits = 512;

// Paths that fill cells end in others of at least so many units.
constexpr std::uint32_t kKnownWell = 8;
// Another unit for every so many rays that end in the cell: filling then costs about half of what
// the rays cost.
constexpr float kRaysAUnit = 16;

// One in so many rays that end in a cell is noted, and stands for all of them. (By chance alone:
// were cells that seem bright filled more, those that seem dark by bad luck would stay so.)
constexpr float kRaysANote = 8;

// One in so many samples also aims at what is bright.
constexpr std::uint32_t kSamplesAnAimedRay = 4;

// A ray that asked for a cell, and where it met the surface.
struct Asking {
    CellKey key;
    float rays;  // that it stands for
    Receiver place;
    CellId cell = CellId::none;  // once it is known
};

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
    float variance(const IrradianceCells& cells) const {
        float sum = 0;
        for (std::size_t i = 0; i < ids_.size(); ++i)
            if (ids_[i] != CellId::none)
                sum += shares_[i] * shares_[i] * cells.cell(ids_[i]).variance();
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

// The cell in which a path ends that met a surface, if there may be one.
std::optional<CellKey> cell_met(const IrradianceCells& cells, const Hit& hit, const Receiver& met,
                                BounceNumbers& numbers) {
    const Vec3 jitter(numbers.next(), numbers.next(), numbers.next());
    return cell_at(cells.grid(), hit.point.object, met.position, met.geometric_normal, hit.t,
                   jitter);
}

// The indirect part of a request, or a glossy request, by rays that end in cells; appends to
// `asking`.
TaskResult gather(const LitScene& lit, IndirectOptions options, const IrradianceCells& cells,
                  const Receiver& receiver, const Task& task, const ShadeRequest& request,
                  Scratch& scratch, std::vector<Asking>& asking) {
    scratch.shares.reset(task.count);
    TaskResult result;
    std::array<Rgb, kReplicates> ended = {};
    const EndsAt ends_at = [&](const Path& path, std::uint32_t bounce, const Hit& hit,
                               const Receiver& met, Rgb reflected) {
        BounceNumbers numbers(hash32(path.key, 0xce11U), bounce);
        const auto key = cell_met(cells, hit, met, numbers);
        if (!key) return false;
        const CellId id = cells.find(*key);
        if (id == CellId::none || cells.cell(id).samples == 0) {
            asking.push_back({*key, 1, met});
            return false;
        }
        const Rgb weight = reflected * (1 / kPi);
        if (numbers.next() * kRaysANote < 1) asking.push_back({*key, kRaysANote, met});
        ended[path.slot] += weight * cells.cell(id).mean;
        scratch.shares.add(id, luminance(weight));
        return true;
    };
    options.ends_at = &ends_at;
    float scale = 1;
    if (task.light == Light::indirect) {
        scale = kPi;
        result.rays =
            add_indirect_samples(lit, receiver, hash32(request.seed, kIndirectSalt), task.first,
                                 task.count, scratch.wave, result.sums, options);
    } else {
        result = run_glossy(lit, task, request, scratch.wave, &ends_at);
    }
    for (std::uint32_t r = 0; r < kReplicates; ++r) result.sums[r] += scale * ended[r];
    result.shared_variance = scale * scale * scratch.shares.variance(cells);
    return result;
}

// A cell that is to be filled further, and the rays that asked for it: askings[first, last).
struct Filling {
    CellId cell;
    std::uint32_t units;
    std::size_t first, last;
};

std::uint32_t units_wanted(float hits) {
    if (hits < kAskedBeforeFilled) return 0;
    return std::clamp(static_cast<std::uint32_t>(hits / kRaysAUnit), kFirstUnits, kMostUnits);
}

// Sorts what was asked for by cell and tells which cells have earned more samples. Doubling them at
// least keeps their number in step with the rays at few visits.
std::vector<Filling> plan(IrradianceCells& cells, std::vector<Asking>& asking) {
    for (Asking& a : asking) {
        a.cell = cells.find_or_add(a.key);
        cells.count_hits(a.cell, a.rays);
    }
    std::stable_sort(asking.begin(), asking.end(),
                     [](const Asking& a, const Asking& b) { return a.cell < b.cell; });

    std::vector<Filling> fillings;
    for (std::size_t first = 0; first < asking.size();) {
        const CellId id = asking[first].cell;
        std::size_t last = first;
        while (last < asking.size() && asking[last].cell == id) ++last;
        const IrradianceCell& cell = cells.cell(id);
        const std::uint32_t wanted = units_wanted(cell.hits);
        if (wanted >= std::max(2 * cell.samples, kFirstUnits))
            fillings.push_back({id, wanted - cell.samples, first, last});
        first = last;
    }
    return fillings;
}

// Irradiance at one place by samples [first, first + kSamplesAUnit) of everything [lux a channel].
// Paths end in cells that are known well.
Rgb sample_irradiance(const LitScene& lit, const IrradianceCells& cells, const Aims* aims,
                      const Receiver& place, std::uint32_t seed, std::uint32_t first,
                      PathWave& scratch) {
    std::array<Rgb, kReplicates> sums = {}, ended = {};
    const Rgb exact = exact_direct_light(lit, place, scratch);
    if (!direct_light_is_exact(lit))
        add_direct_samples(lit, place, hash32(seed, kDirectSalt), first, kSamplesAUnit, scratch,
                           sums);
    const EndsAt ends_at = [&](const Path& path, std::uint32_t bounce, const Hit& hit,
                               const Receiver& met, Rgb reflected) {
        BounceNumbers numbers(hash32(path.key, 0xce11U), bounce);
        const auto key = cell_met(cells, hit, met, numbers);
        if (!key) return false;
        const CellId id = cells.find(*key);
        if (id == CellId::none || cells.cell(id).samples < kKnownWell) return false;
        ended[path.slot] += reflected * cells.cell(id).mean;
        return true;
    };
    add_indirect_samples(lit, place, hash32(seed, kIndirectSalt), first, kSamplesAUnit, scratch,
                         sums, {.ends_at = &ends_at, .aims = aims});
    Rgb sum(0);
    for (std::uint32_t r = 0; r < kReplicates; ++r) sum += sums[r] + ended[r];
    return exact + sum * (1.0f / kSamplesAUnit);
}

CellSamples fill(const LitScene& lit, const IrradianceCells& cells, const Aims* aims,
                 const Filling& filling, std::span<const Asking> asking, PathWave& scratch) {
    const IrradianceCell& cell = cells.cell(filling.cell);
    const std::uint32_t seed = hash64(static_cast<std::uint64_t>(cell.key));
    const std::size_t places = filling.last - filling.first;
    CellSamples samples;
    for (std::uint32_t u = 0; u < filling.units; ++u) {
        const Receiver& place = asking[filling.first + (places * u / filling.units) % places].place;
        // The cell's sequence goes on from place to place, so that it is spread well over all.
        samples.add(sample_irradiance(lit, cells, aims, place, seed,
                                      kSamplesAUnit * (cell.samples + u), scratch));
    }
    return samples;
}

}  // namespace

GatherRenderer::GatherRenderer(const Scene& scene, const RayCaster& caster,
                               const AreaLights& area_lights, const OpenSides* open_sides,
                               int threads)
    : lit_(make_lit_scene(scene, caster, area_lights)),
      open_sides_(open_sides),
      threads_(threads),
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
        std::vector<std::vector<Asking>> asked(end - begin);
        parallel_for(threads_, end - begin, [&](std::size_t i) {
            thread_local Scratch scratch;
            const Task& task = tasks[begin + i];
            const ShadeRequest& request = requests[task.request];
            const Receiver receiver = request_receiver(lit_, request);
            TaskResult& part = parts[begin + i];
            part = task.light == Light::direct
                       ? run_direct(lit_, receiver, task, request, scratch.wave)
                       : gather(lit_, options, cells_, receiver, task, request, scratch, asked[i]);
            probe_if_dark(lit_, open_sides_, receiver, task, request, scratch.wave, part);
        });

        // What it asked for, in the order of tasks.
        std::vector<Asking> asking;
        for (const auto& some : asked) asking.insert(asking.end(), some.begin(), some.end());
        const std::vector<Filling> fillings = plan(cells_, asking);
        std::vector<CellSamples> filled(fillings.size());
        parallel_for(threads_, fillings.size(), [&](std::size_t i) {
            thread_local PathWave scratch;
            filled[i] = fill(lit_, cells_, options.aims, fillings[i], asking, scratch);
        });
        for (std::size_t i = 0; i < fillings.size(); ++i)
            cells_.store(fillings[i].cell, filled[i], version_);
        begin = end;
    }
    combine(requests, tasks, parts, results);
}

}  // namespace chiaro
