// The first cycles of a view: a whole picture, as good as its seconds can pay.

#include "sample_selector/relocate_hidden.h"
#include "update/start_level.h"
#include "update/update_cycle.h"

#include <algorithm>

namespace chiaro {
namespace {

// A cycle of fixed size asks for about as much as this.
constexpr double kFixedFirstPictureSeconds = 0.15;

// Direct light's part of the first picture's time; glossy light's, where it lights the whole
// picture.
constexpr double kDirectShare = 0.15;
constexpr double kGlossyShare = 0.5;

// How long a cycle may be while edits come all the time, in times of what it adjusts itself to; the
// least part of that for a start, however long the map has taken; and how much dearer samples may
// turn out, of a scene that the renderer has yet to learn.
constexpr double kDraggedCycle = 1.5;
constexpr double kLeastStart = 0.4;
constexpr double kMostOverrun = 4;

}  // namespace

// Everything in view, at an even density that the first picture's budget can pay. The paper's
// scheme evaluates the roots as they are.
void UpdateCycle::start() {
    ShadeWork work = new_work();
    {
        const StepTimer timer(statistics_.timings, Step::patch_subdivision);
        if (edited_) lower_what_changes();
        attach_front();
    }
    if (settings_.scheme == Scheme::best && !settings_.fixed_size && cost_learning_ == 0)
        measure_costs();
    {
        const StepTimer timer(statistics_.timings, Step::patch_subdivision);
        const double seconds = start_seconds();
        for (int c = 0; c < cache_.channels(); ++c) start_channel(c, seconds, work);
        if (!in_haste() && hasty_) judge_buried_again(work);
        hasty_ = in_haste();
    }
    const auto before = std::chrono::steady_clock::now();
    const double planned = work_seconds(work);
    shade(work);
    if (settings_.scheme == Scheme::best) dig_out();
    if (in_haste() && planned > 0) {
        const double taken = seconds_since(before) * threads_at_once() / planned;
        overrun_ += 0.3 * (std::clamp(taken, 1.0, kMostOverrun) - overrun_);
    }
    estimate_exposure();
    refresh(Extent::everything);
}

// Vertices that few samples found dark while edits came in every cycle.
void UpdateCycle::judge_buried_again(ShadeWork& work) {
    for (std::size_t i = 0; i < cache_.vertices().size(); ++i) {
        const auto v = static_cast<VertexId>(i);
        if (!cache_.vertex(v).buried || !cache_.dark(v)) continue;
        for (int c = 0; c < cache_.channels(); ++c) {
            const Estimate* e = cache_.estimate(v, c);
            if (!plans_[c].zero_is_buried || !e || e->samples >= ShadeWork::kEnoughToBeDark)
                continue;
            cache_.unmark_buried(v);
            work.resample(cache_, v, c, ShadeWork::kEnoughToBeDark);
        }
    }
}

void UpdateCycle::attach_front() {
    cache_.take_forgotten();  // the front asks for everything anew
    mesh_front_.attach(cache_);
    relocate_hidden(cache_, mesh_front_);
}

// A face whose corners all lie in its neighbours would be black: divides such patches at once,
// until something of them is known.
void UpdateCycle::dig_out() {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    constexpr int kMostRounds = 8;
    for (int round = 0; round < kMostRounds; ++round) {
        ShadeWork work = new_work();
        touched_.clear();
        cache_.resolve();
        cache_.forget_changes();  // all gains are reckoned in the end
        for (int c = 0; c < cache_.channels(); ++c) {
            for (const VertexId v : hollow_in_view(cache_, mesh_front_, c))
                work.evaluate(cache_, v, c);
            for (const PatchId patch : dug_in(cache_, c)) divide(patch, c, work);
        }
        if (work.points() == 0) break;
        shade(work);
        // More is to come, and digs on.
        if (in_haste() && !settings_.fixed_size && seconds_left(0) == 0) break;
    }
    for (std::size_t i = 0; i < cache_.patches().size(); ++i)
        expose_if_seen(cache_, static_cast<PatchId>(i));
}

// Processor seconds for the first picture. While edits come in every cycle, half of what the map
// has left of one.
double UpdateCycle::start_seconds() const {
    if (settings_.fixed_size) return kFixedFirstPictureSeconds;
    if (in_haste()) return 0.5 * seconds_left(kLeastStart) / overrun_;
    return threads_at_once() *
           (moving_ ? settings_.clean_up_seconds : settings_.first_picture_seconds);
}

// Processor seconds until this cycle is as long as may be, and no fewer than a part of one.
double UpdateCycle::seconds_left(double fewest) const {
    const double left = kDraggedCycle * settings_.cycle_seconds - seconds_since(cycle_start_);
    return threads_at_once() * std::max(left, fewest * settings_.cycle_seconds);
}

double UpdateCycle::first_picture_share(int channel) const {
    double glossy_pixels = 0;
    for (const Patch& patch : cache_.patches())
        if (patch.is_root()) glossy_pixels += patch.glossy_pixels;
    const auto pixels = static_cast<double>(map_.background.pixels.size());
    const double glossy = kGlossyShare * std::min(1.0, glossy_pixels / pixels);
    if (plans_[channel].light == Light::glossy) return glossy;
    return (1 - glossy) *
           (plans_[channel].light == Light::direct ? kDirectShare : 1 - kDirectShare);
}

// Vertices that a channel's share of so many processor seconds can pay.
double UpdateCycle::affordable(int channel, double seconds, std::uint32_t samples) const {
    return seconds * first_picture_share(channel) /
           (samples * static_cast<double>(gains_.seconds_a_sample[channel]));
}

// What samples cost in this scene on this machine, by a few vertices that the first picture needs
// in any case. The first half of them pays for what a renderer learns once.
void UpdateCycle::measure_costs() {
    const std::size_t at_once = 32 * static_cast<std::size_t>(std::max(2, threads_at_once()));
    std::vector<std::vector<VertexId>> vertices;
    for (int c = 0; c < cache_.channels(); ++c) {
        const auto counts = mesh_front_.count_by_level(cache_.shading(c));
        int level = MeshFront::kLevels - 1;
        while (level > 0 && counts[level] < 2 * at_once) --level;
        const auto missing = missing_in_view(cache_, mesh_front_, c, level);
        // From all over the picture, not from its first rows.
        std::vector<VertexId> some;
        const std::size_t step = std::max<std::size_t>(1, missing.size() / (2 * at_once));
        for (std::size_t i = 0; i < missing.size() && some.size() < 2 * at_once; i += step)
            some.push_back(missing[i]);
        vertices.push_back(std::move(some));
    }
    for (int half = 0; half < 2; ++half) {
        cost_learning_ = static_cast<float>(half);
        for (int c = 0; c < cache_.channels(); ++c) {
            const std::size_t begin = std::min(half * at_once, vertices[c].size());
            const std::size_t end = std::min(begin + at_once, vertices[c].size());
            ShadeWork work = new_work();
            evaluate(std::span(vertices[c]).subspan(begin, end - begin), c, plans_[c].first_samples,
                     work);
            shade(work);
        }
    }
    cost_learning_ = 0.2f;
}

// Asks for the vertices that a channel's share of the first picture's seconds can pay: those of
// coarser levels where meshes are too dense for it, those of divided patches where they are too
// coarse.
void UpdateCycle::start_channel(int channel, double seconds, ShadeWork& work) {
    const std::uint32_t fewest = plans_[channel].first_samples;
    if (settings_.scheme == Scheme::paper) {
        evaluate(missing_in_view(cache_, mesh_front_, channel, 0), channel, fewest, work);
        return;
    }
    const std::uint32_t most = fewest * kMostFirstSamples;
    const auto vertices = [&](std::uint32_t samples) {
        return static_cast<std::size_t>(affordable(channel, seconds, samples));
    };
    const StartLevel start =
        choose_start_level(cache_, mesh_front_, channel, vertices(most), vertices(fewest));
    even_out(cache_, map_, mesh_front_, channel, start, static_cast<Cycle>(statistics_.cycles));
    const auto missing = missing_in_view(cache_, mesh_front_, channel, start.level);
    // More samples than the plan says where few vertices are needed, since noise is seen before
    // interpolation is.
    std::uint32_t samples = most;
    while (samples > fewest && vertices(samples) < missing.size()) samples /= 2;
    evaluate(missing, channel, samples, work);
}

void UpdateCycle::evaluate(std::span<const VertexId> vertices, int channel, std::uint32_t samples,
                           ShadeWork& work) const {
    for (const VertexId v : vertices) work.evaluate(cache_, v, channel, samples);
}

}  // namespace chiaro
