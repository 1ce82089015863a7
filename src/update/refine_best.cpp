// Refinement of the best scheme: patches drawn at random in proportion to what they would gain.

#include "base/parallel.h"
#include "sample_selector/gain.h"
#include "update/start_level.h"
#include "update/update_cycle.h"

#include <algorithm>

namespace chiaro {
namespace {

// Equation 1's epsilon: the part of the choices that priorities have no say in.
constexpr float kChance = 0.03f;

}  // namespace

void UpdateCycle::refine() {
    ShadeWork work = new_work();
    touched_.clear();
    choose(work);
    shade(work);
    {
        const StepTimer timer(statistics_.timings, Step::sample_selection);
        for (const auto& [patch, channel] : touched_) {
            expose_if_seen(cache_, patch);
            front_[channel].set(index_of(patch), front_gain(patch, channel));
        }
    }
    // Neighbours of what was shaded learn of it here. Waiting for a fifth of the vertices keeps
    // this pass over everything a small part of the whole.
    if (points_since_refresh_ * 5 > cache_.vertices().size()) refresh();
}

double UpdateCycle::seconds_budget() const {
    constexpr double kFixedSeconds = 0.05;
    return settings_.fixed_size ? kFixedSeconds : settings_.cycle_seconds * threads_at_once();
}

double UpdateCycle::work_seconds(const ShadeWork& work) const {
    double seconds = 0;
    for (int c = 0; c < cache_.channels(); ++c)
        seconds += static_cast<double>(work.samples(c)) * gains_.seconds_a_sample[c];
    return seconds;
}

void UpdateCycle::choose(ShadeWork& work) {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    const double budget = seconds_budget() * (1 - polish_share());
    // Each choice either adds work or takes a patch out of the draw, so this ends.
    for (int tries = 0; tries < 200000 && work_seconds(work) < budget; ++tries) {
        if (rng_.uniform() < kChance) {
            spend_by_chance(work);
            continue;
        }
        PatchId patch = PatchId::none;
        int channel = 0;
        if (!draw_patch(patch, channel)) break;
        spend_on(patch, channel, work);
    }
}

// Whatever lies below a random pixel is divided, or sampled again at a random corner: an error that
// no estimate shows is found in the end.
void UpdateCycle::spend_by_chance(ShadeWork& work) {
    const auto below = [&](std::size_t n) { return rng_.below(static_cast<std::uint32_t>(n)); };
    const int channel = static_cast<int>(below(cache_.channels()));
    const PatchId id = front_patch_at(below(map_.first_of_pixel.size() - 1), channel);
    if (id == PatchId::none) return;
    const Patch& patch = cache_.patch(id);
    if (rng_.below(2) == 0) {
        work.resample(cache_, patch.corners[below(patch.corner_count())], channel);
        touched_.emplace_back(id, channel);
    } else if (patch.fragment_count > 1 && patch.divisible()) {
        front_[channel].set(index_of(id), 0);
        divide(id, channel, work);
    }
}

bool UpdateCycle::draw_patch(PatchId& patch, int& channel) {
    double total = 0;
    for (const SumTree& tree : front_) total += tree.total();
    if (!(total > 0)) return false;
    double rest = rng_.uniform() * total;
    for (channel = 0; channel + 1 < cache_.channels(); ++channel) {
        if (rest < front_[channel].total()) break;
        rest -= front_[channel].total();
    }
    if (!(front_[channel].total() > 0)) return false;
    patch = static_cast<PatchId>(front_[channel].draw(rng_.uniform()));
    return true;
}

// The front's patch in a channel below a pixel; none where the channel lights nothing.
PatchId UpdateCycle::front_patch_at(std::uint32_t pixel, int channel) {
    const auto fragments = map_.at_pixel(pixel);
    if (fragments.empty()) return PatchId::none;
    PatchId id = fragments[rng_.below(static_cast<std::uint32_t>(fragments.size()))].patch;
    if (!(cache_.pixels(cache_.patch(id), channel) > 0)) return PatchId::none;
    while (!on_front(cache_, id, channel)) id = static_cast<PatchId>(cache_.patch(id).parent);
    return id;
}

// Does the better of the two things that can be done for a patch: refine, or sample its noisiest
// corner again. Its gain is reckoned anew once that is shaded.
void UpdateCycle::spend_on(PatchId id, int channel, ShadeWork& work) {
    const Gain g = gain(cache_, id, channel, gains_);
    front_[channel].set(index_of(id), 0);
    if (g.resample > g.refine) {
        work.resample(cache_, g.noisiest, channel);
        touched_.emplace_back(id, channel);
        return;
    }
    if (g.refine > 0) divide(id, channel, work);
}

// Refines a channel in a patch of its front: divides the patch if nobody has yet, and asks for the
// children's corners that are in view.
void UpdateCycle::divide(PatchId id, int channel, ShadeWork& work) {
    if (cache_.patch(id).is_leaf()) {
        const StepTimer timer(statistics_.timings, Step::patch_subdivision);
        subdivide_seen(cache_, map_, id, static_cast<Cycle>(statistics_.cycles));
        for (SumTree& tree : front_) tree.resize(cache_.patches().size());
    }
    const std::uint32_t samples = samples_of_new(cache_, id, channel, gains_);
    cache_.patch(id).refined_channels |= static_cast<std::uint8_t>(1u << channel);
    for (int c = 0; c < child_count(cache_.patch(id).split); ++c) {
        const PatchId child = offset_by(cache_.patch(id).first_child, c);
        const Patch& p = cache_.patch(child);
        if (!(cache_.pixels(p, channel) > 0)) continue;
        for (int i = 0; i < p.corner_count(); ++i)
            work.evaluate(cache_, p.corners[i], channel, samples);
        touched_.emplace_back(child, channel);
    }
}

float UpdateCycle::front_gain(PatchId id, int channel) const {
    if (!(cache_.pixels(cache_.patch(id), channel) > 0) || !on_front(cache_, id, channel)) return 0;
    return gain(cache_, id, channel, gains_).best();
}

void UpdateCycle::refresh() {
    {
        const StepTimer timer(statistics_.timings, Step::update_display_meshes);
        cache_.resolve();
    }
    points_since_refresh_ = 0;
    if (statistics_.points_shaded > 2 * points_at_exposure_) estimate_exposure();
    if (settings_.scheme == Scheme::paper) return;
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    for (int c = 0; c < cache_.channels(); ++c) {
        std::vector<float> gains(cache_.patches().size(), 0.0f);
        constexpr std::size_t kBlock = 1024;
        parallel_for(settings_.threads, (gains.size() + kBlock - 1) / kBlock,
                     [&](std::size_t block) {
                         const std::size_t last = std::min(gains.size(), (block + 1) * kBlock);
                         for (std::size_t i = block * kBlock; i < last; ++i)
                             gains[i] = front_gain(static_cast<PatchId>(i), c);
                     });
        front_[c].assign(gains);
    }
}

}  // namespace chiaro
