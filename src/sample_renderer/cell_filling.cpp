#include "sample_renderer/cell_filling.h"

#include "base/parallel.h"
#include "sample_renderer/direct_light.h"
#include "sample_renderer/shade_tasks.h"

#include <algorithm>

namespace chiaro {
namespace {

// A cell is filled once this many rays have asked for it: about as many paths as filling it costs.
constexpr float kAskedBeforeFilled = 8;

// One unit of filling: this many direct samples and as many traced paths from one place.
constexpr std::uint32_t kSamplesAUnit = 4;
static_assert(kSamplesAUnit % kReplicates == 0);
constexpr std::uint32_t kFirstUnits = 2;
constexpr std::uint32_t kMostUnits = 512;

// Another unit for every so many rays that end in the cell: filling then costs about half of what
// the rays cost.
constexpr float kRaysAUnit = 16;

// Units whose rays go together, in full packets.
constexpr std::size_t kUnitsAWave = 64;

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
        if (a.cell != CellId::none) cells.count_hits(a.cell, a.rays);
    }
    std::stable_sort(asking.begin(), asking.end(),
                     [](const Asking& a, const Asking& b) { return a.cell < b.cell; });

    std::vector<Filling> fillings;
    for (std::size_t first = 0; first < asking.size();) {
        const CellId id = asking[first].cell;
        std::size_t last = first;
        while (last < asking.size() && asking[last].cell == id) ++last;
        if (id == CellId::none) break;  // the last ones: there was no room
        const std::uint32_t has = cells.known(id) ? cells.cell(id).samples : 0;
        const std::uint32_t wanted = units_wanted(cells.cell(id).hits);
        if (wanted >= std::max(2 * has, kFirstUnits))
            fillings.push_back({id, wanted - has, first, last});
        first = last;
    }
    return fillings;
}

// Every unit of all fillings, in order. A cell's sequence goes on from place to place, so that it
// is spread well over all.
std::vector<SampleRun> units_of(const IrradianceCells& cells, std::span<const Filling> fillings,
                                std::span<const Asking> asking, std::uint32_t seed_of_all) {
    std::vector<SampleRun> units;
    for (const Filling& filling : fillings) {
        const IrradianceCell& cell = cells.cell(filling.cell);
        const std::uint32_t seed = hash32(
            static_cast<std::uint32_t>(hash64(static_cast<std::uint64_t>(cell.key))), seed_of_all);
        const std::size_t places = filling.last - filling.first;
        for (std::uint32_t u = 0; u < filling.units; ++u)
            units.push_back({asking[filling.first + (places * u / filling.units) % places].place,
                             seed, kSamplesAUnit * (cell.samples + u), kSamplesAUnit});
    }
    return units;
}

struct Scratch {
    PathWave wave;
    std::vector<SampleRun> runs;
    std::vector<Rgb> sums;
};

std::span<const SampleRun> salted(std::span<const SampleRun> units, std::uint32_t salt,
                                  std::vector<SampleRun>& runs) {
    runs.assign(units.begin(), units.end());
    for (SampleRun& run : runs) run.seed = hash32(run.seed, salt);
    return runs;
}

// Irradiance by each unit, of light from anywhere [lux a channel].
void sample_units(const LitScene& lit, const IrradianceCells& cells, const Aims* aims,
                  std::span<const SampleRun> units, Scratch& scratch, std::span<Rgb> irradiance) {
    std::vector<Rgb>& sums = scratch.sums;
    sums.assign(kReplicates * units.size(), Rgb(0));
    add_exact_direct_light(lit, units, scratch.wave, irradiance);
    if (!direct_light_is_exact(lit))
        add_direct_samples(lit, salted(units, kDirectSalt, scratch.runs), scratch.wave, sums);
    const EndsAt ends_at = [&](const Meetings& met) {
        CellFound found[kLanes];
        std::uint32_t ended = 0;
        const Lanes3 reflected(met.reflected);
        for_each_lane(find_cells(cells, met, found), [&](int i) {
            if (found[i].ends_in == CellId::none) return;
            ended |= 1U << i;
            sums[met.paths[i].slot] += reflected.lane(i) * cells.cell(found[i].ends_in).mean;
        });
        return ended;
    };
    add_indirect_samples(lit, salted(units, kIndirectSalt, scratch.runs), scratch.wave, sums,
                         {.ends_at = &ends_at, .aims = aims});
    for (std::size_t i = 0; i < sums.size(); ++i)
        irradiance[i / kReplicates] += sums[i] * (1.0f / kSamplesAUnit);
}

}  // namespace

std::uint32_t find_cells(const IrradianceCells& cells, const Meetings& meetings,
                         std::span<CellFound, kLanes> found) {
    constexpr std::uint32_t kCellSalt = 0xce11;
    CellVisit visits[kLanes];
    int finest[kLanes];
    const Lanes3 positions(meetings.met.position), normals(meetings.met.geometric_normal);
    std::uint32_t lanes = 0;

    // Memory is asked for everything before anything is looked at.
    for_each_lane(meetings.lanes, [&](int i) {
        const Hit& hit = meetings.hits[i];
        const auto level = level_of(cells.grid(), hit.t);
        if (!level) return;
        lanes |= 1U << i;
        finest[i] = *level;
        BounceNumbers numbers(hash32(meetings.paths[i].key, kCellSalt), meetings.bounce);
        const Vec3 jitter(numbers.next(), numbers.next(), numbers.next());
        visits[i] = {hit.point.object, positions.lane(i), normals.lane(i), jitter};
        found[i] = {CellId::none, cell_at(cells.grid(), visits[i], finest[i])};
        cells.prefetch(found[i].wants);
    });
    for_each_lane(lanes, [&](int i) {
        found[i].ends_in = cells.find(found[i].wants);
        if (found[i].ends_in != CellId::none) cells.prefetch(found[i].ends_in);
    });
    for_each_lane(lanes, [&](int i) {
        if (cells.known(found[i].ends_in)) return;
        found[i].ends_in = CellId::none;
        if (finest[i] == 0) return;
        const CellKey coarser = cell_at(cells.grid(), visits[i], finest[i] - 1);
        const CellId id = cells.find(coarser);
        if (cells.known(id))
            found[i].ends_in = id;
        else
            found[i].wants = coarser;
    });
    return lanes;
}

void fill_cells(const LitScene& lit, const Aims* aims, int threads, std::uint32_t seed,
                IrradianceCells& cells, std::vector<Asking>& asking) {
    const std::vector<Filling> fillings = plan(cells, asking);
    const std::vector<SampleRun> units = units_of(cells, fillings, asking, seed);
    std::vector<Rgb> irradiance(units.size(), Rgb(0));
    const std::size_t waves = (units.size() + kUnitsAWave - 1) / kUnitsAWave;
    parallel_for(threads, waves, [&](std::size_t wave) {
        thread_local Scratch scratch;
        const std::size_t first = wave * kUnitsAWave;
        const std::size_t count = std::min(kUnitsAWave, units.size() - first);
        sample_units(lit, cells, aims, std::span(units).subspan(first, count), scratch,
                     std::span(irradiance).subspan(first, count));
    });

    std::size_t unit = 0;
    for (const Filling& filling : fillings) {
        CellSamples samples;
        for (std::uint32_t u = 0; u < filling.units; ++u) samples.add(irradiance[unit++]);
        cells.store(filling.cell, samples);
    }
}

}  // namespace chiaro
