// Section 5: what the cycle makes of a scene and a camera that move.

#include "update/lower_resolution.h"
#include "update/outdate.h"
#include "update/update_cycle.h"

#include <algorithm>

namespace chiaro {
namespace {

// Squared relative change from which on a coarser picture of what is now is worth more than a fine
// one of what was.
constexpr float kChanging = 0.1f;

// And from which on a change counts as found: a tenth of the light.
constexpr float kFound = 0.01f;

}  // namespace

void UpdateCycle::look_from(const View& view) {
    const auto now = static_cast<Cycle>(statistics_.cycles);
    if (view_ && view_->eye() != view.eye() && cache_.has_glossy()) {
        gloss_rates_ = outdate_gloss(cache_, rays_->scene(), {eye_track_, now, view.eye()},
                                     least_light(gains_.scale), expected_, settings_.threads);
        edited_ = true;
        gloss_stale_at_ = now;
    }
    eye_track_.move_to(view.eye(), now);
    view_ = view;
    view_change_.everywhere = true;
    stage_ = Stage::new_view;
    note_change();
}

void UpdateCycle::scene_changed(const SceneChange& change, SampleRenderer& renderer) {
    renderer_ = &renderer;
    if (!change.any()) return;
    follow_plans();
    cache_.follow_scene(change.repainted);
    outdate(cache_, rays_->scene(), plans_, change, least_light(gains_.scale), expected_,
            settings_.threads);
    // Of a motion of the eye that is over.
    if (stage_ == Stage::refining) gloss_rates_.clear();
    edited_ = moving_ = true;
    edited_at_ = gloss_stale_at_ = static_cast<Cycle>(statistics_.cycles);
    view_change_.add(view_change_of(change));
    if (stage_ != Stage::nothing) stage_ = Stage::new_view;
    note_change();
}

// Who drags something has done so a moment before.
void UpdateCycle::note_change() {
    constexpr Cycle kMoment = 3;
    const auto now = static_cast<Cycle>(statistics_.cycles);
    if (changed_at_ == now) return;
    dragged_ = changed_at_ && now - *changed_at_ <= kMoment;
    changed_at_ = now;
}

// What an edit has outdated shows what it showed until it is shaded again; but where most of that
// is wrong by now, it is shaded at once, as fine as the user's time for it can pay.
void UpdateCycle::lower_what_changes() {
    edited_ = false;
    stale_ = {1, 1};  // to be counted
    const double seconds = start_seconds();
    for (int c = 0; c < cache_.channels(); ++c) {
        std::vector<char> changing;
        for (std::size_t o = 0; o < rays_->scene().objects.size(); ++o)
            changing.push_back(expected_.relative2(static_cast<ObjectId>(o), c) > kChanging);
        const ChannelPlan& plan = plans_[c];
        const std::uint32_t samples = settings_.scheme == Scheme::paper
                                          ? plan.first_samples + plan.indirect_samples
                                          : (dragged_ ? 1 : kMostFirstSamples) * plan.first_samples;
        lower_resolution(cache_, c, changing,
                         static_cast<std::size_t>(affordable(c, seconds, samples)),
                         dragged_ ? Rest::waits : Rest::too);
    }
}

// 5.2: "the age priority is chosen to be the maximum of the age priorities from view dependence and
// motion dependence". Objects age that were found to change.
std::vector<float> UpdateCycle::age_rates() const {
    std::vector<float> rates(rays_->scene().objects.size(), 0.0f);
    for (std::size_t o = 0; o < rates.size(); ++o) {
        if (o < gloss_rates_.size()) rates[o] = gloss_rates_[o];
        for (int c = 0; c < cache_.channels(); ++c)
            if (expected_.relative2(static_cast<ObjectId>(o), c) > kFound)
                rates[o] = std::max(rates[o], 1.0f);
    }
    return rates;
}

// Luminance of what is stale and about to be shaded again; negative where nothing is.
std::vector<float> UpdateCycle::stale_light(const ShadeWork& work, int channel) const {
    std::vector<float> light;
    if (stale_.all == 0) return light;
    for (const VertexId v : work.vertices(channel)) {
        const Estimate* e = cache_.estimate(v, channel);
        light.push_back(e && e->stale ? luminance(e->mean) : -1.0f);
    }
    return light;
}

void UpdateCycle::learn_change(const ShadeWork& work, int channel, std::span<const float> before) {
    const LeastLight least = least_light(gains_.scale);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] < 0) continue;
        const VertexId v = work.vertices(channel)[i];
        const Estimate& e = *cache_.estimate(v, channel);
        const float miss = luminance(e.mean) - before[i];
        const float noise = 2 * static_cast<float>(e.variance);  // the old one had its own
        expected_.found(cache_.surface_point(v).object, channel,
                        (miss * miss - noise) / light2(cache_, v, channel, least));
    }
}

}  // namespace chiaro
