// Refinement as the paper has it (3.1, 4): pixels selected by priority, the patches under them
// shaded or divided into four, those with more samples first.

#include "update/update_cycle.h"

#include <algorithm>
#include <chrono>

namespace chiaro {
namespace {

bool all_evaluated(const ShadingCache& cache, const Patch& patch) {
    for (int channel = 0; channel < cache.channels(); ++channel)
        for (int c = 0; c < patch.corner_count(); ++c)
            if (cache.pixels(patch, channel) > 0 && !cache.evaluated(patch.corners[c], channel))
                return false;
    return true;
}

constexpr std::size_t kFixedSampleCount = 128;

}  // namespace

void UpdateCycle::refine_as_paper() {
    const auto start = std::chrono::steady_clock::now();
    std::vector<SelectedPatch> selected;
    {
        const StepTimer timer(statistics_.timings, Step::sample_selection);
        const auto now = static_cast<std::uint32_t>(statistics_.cycles);
        const std::vector<float> rates = stale_.all > 0 ? age_rates() : std::vector<float>();
        const PriorityMap map =
            make_priority_map(cache_, map_, gains_.scale, now, {.rates = rates, .now = now});
        SelectionSettings settings;
        settings.sample_count = settings_.fixed_size
                                    ? kFixedSampleCount
                                    : static_cast<std::size_t>(paper_sample_count_);
        selection_ = select_samples(map, settings, rng_);
        selected = count_by_patch(map, selection_);
    }

    ShadeWork work = new_work();
    {
        const StepTimer timer(statistics_.timings, Step::patch_subdivision);
        for (const auto& [patch, samples] : selected) shade_or_subdivide(patch, work);
    }
    shade(work);
    {
        const StepTimer timer(statistics_.timings, Step::update_display_meshes);
        cache_.resolve();
        cache_.forget_changes();
    }

    // The next cycle asks for as many as would have filled this one's time.
    const double seconds = seconds_since(start);
    const double length = settings_.cycle_seconds * (1 - polish_share());
    const double factor = std::clamp(length / seconds, 0.5, 2.0);
    paper_sample_count_ = std::clamp(paper_sample_count_ * factor, 8.0, 1e6);
}

// Section 5: what was shaded before something moved is shaded again. Returns whether any was.
bool UpdateCycle::resample_stale(const Patch& patch, ShadeWork& work) const {
    bool any = false;
    for (int channel = 0; channel < cache_.channels(); ++channel)
        for (int c = 0; c < patch.corner_count(); ++c) {
            const Estimate* e = cache_.estimate(patch.corners[c], channel);
            if (!e || !e->stale) continue;
            work.resample(cache_, patch.corners[c], channel, plans_[channel].first_samples);
            any = true;
        }
    return any;
}

// 3.1: "we either evaluate the shading values for its vertices or subdivide the patch into four
// children and evaluate the shading values for their vertices", down to one pixel.
void UpdateCycle::shade_or_subdivide(PatchId id, ShadeWork& work) {
    const auto evaluate = [&](const Patch& p) {
        for (int channel = 0; channel < cache_.channels(); ++channel)
            for (int c = 0; c < p.corner_count(); ++c)
                if (cache_.pixels(cache_.patch(id), channel) > 0)
                    work.evaluate(cache_, p.corners[c], channel);
    };
    if (resample_stale(cache_.patch(id), work)) return;
    if (!all_evaluated(cache_, cache_.patch(id))) {
        evaluate(cache_.patch(id));
    } else if (cache_.patch(id).fragment_count > 1 && cache_.patch(id).divisible()) {
        const PatchId first =
            subdivide_seen(cache_, map_, id, static_cast<Cycle>(statistics_.cycles));
        cache_.patch(id).refined_channels =
            static_cast<std::uint8_t>((1u << cache_.channels()) - 1);
        for (int c = 0; c < 4; ++c) evaluate(cache_.patch(offset_by(first, c)));
    }
}

}  // namespace chiaro
