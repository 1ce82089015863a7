// The map: made anew where the eye or what it sees has changed, and kept elsewhere.

#include "base/random.h"
#include "image_generator/view_curves.h"
#include "update/glints.h"
#include "update/update_cycle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace chiaro {
namespace {

// Of a cycle's time, for glints while edits come in every cycle.
constexpr double kGlintShare = 0.2;

// Of a glint among those of its pixel: other edits and other pixels do not change its sequence.
std::uint32_t place_in_pixel(const std::vector<Glint>& glints, std::size_t i) {
    std::uint32_t place = 0;
    while (place < i && glints[i - place - 1].pixel == glints[i].pixel) ++place;
    return place;
}

}  // namespace

ShadeRequest glint_request(const Glint& glint, std::uint32_t seed, std::uint32_t samples) {
    ShadeRequest request;
    request.where = glint.where;
    request.front = glint.front;
    request.light = Light::glint;
    request.eye = glint.seen_from;
    request.seed = seed;
    const float part = std::min(max_component(glint.weight), 1.0f);
    request.samples =
        kReplicates *
        static_cast<std::uint32_t>(std::ceil(part * static_cast<float>(samples / kReplicates)));
    return request;
}

RayViewSettings UpdateCycle::view_settings() const {
    return {.aov = settings_.aov,
            .threads = settings_.threads,
            .cached_facets = settings_.cached_facets,
            .environment = environment_};
}

// After edits or a look from elsewhere. Where only lights changed that have no surface, the map
// stays as fine as it is; where objects moved, only what they hid or hide is seen again.
void UpdateCycle::renew_map() {
    const ViewChange change = std::exchange(view_change_, {});
    if (change.any()) {
        const StepTimer timer(statistics_.timings, Step::tessellation);
        show_curves(*rays_, *view_, settings_.threads);
    }
    if (change.everywhere)
        make_map(ViewQuality::one_ray);
    else if (change.any() && seen_)
        see_changes(change.boxes);
    else if (change.any())
        make_map(ViewQuality::one_ray);
    light_glints(kGlintSamples / 4);
}

// All of it. Where objects moved they soon will again, and it pays to know where rays went.
void UpdateCycle::make_map(ViewQuality quality) {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    RayViewSettings view = view_settings();
    view.quality = quality;
    map_quality_ = quality;
    seen_.reset();
    if (quality == ViewQuality::one_ray && moving_) {
        seen_ = see_view(cache_, *rays_, *view_, view, open_sides_);
        map_ = seen_->map;
    } else {
        map_ = make_id_map(cache_, *rays_, *view_, view, open_sides_);
    }
    if (quality == ViewQuality::one_ray) statistics_.pixels_seen += map_.background.pixels.size();
    attach_map();
}

// Glints know their light in the map alone, and pixels that stay keep it.
void UpdateCycle::see_changes(std::span<const Box> boxes) {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    RayViewSettings view = view_settings();
    view.quality = map_quality_;
    seen_->map.glints = std::move(map_.glints);
    statistics_.pixels_seen +=
        chiaro::see_changes(*seen_, cache_, *rays_, *view_, view, open_sides_, boxes);
    map_ = seen_->map;
    attach_map();
}

void UpdateCycle::attach_map() {
    attach(cache_, map_, static_cast<Cycle>(statistics_.cycles), settings_.threads);
    unlit_ = map_.background;
}

// What polish shows of lights is sampled a pixel, as the view is.
void UpdateCycle::light_glints(std::uint32_t samples) {
    const StepTimer timer(statistics_.timings, Step::rendering);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::size_t> chosen = glints_to_light(samples);
    std::vector<ShadeRequest> requests;
    std::size_t sample_count = 0;
    for (const std::size_t i : chosen) {
        const std::uint32_t seed = hash32(hash64(settings_.seed), map_.glints[i].pixel);
        requests.push_back(
            glint_request(map_.glints[i], hash32(seed, place_in_pixel(map_.glints, i)), samples));
        sample_count += requests.back().samples;
    }
    std::vector<ShadeResult> results(requests.size());
    renderer_->shade(requests, results);
    for (std::size_t i = 0; i < results.size(); ++i) {
        map_.glints[chosen[i]].light = results[i].mean;
        map_.glints[chosen[i]].lit = true;
    }

    map_.background = unlit_;
    for (const Glint& glint : map_.glints)
        map_.background.pixels[glint.pixel] += glint.weight * glint.light;
    if (sample_count > 0)
        seconds_a_glint_sample_ =
            seconds_since(start) * threads_at_once() / static_cast<double>(sample_count);
}

// All, or while edits come in every cycle those that were never lit, and of the others as many in
// turn as a part of the cycle can pay.
std::vector<std::size_t> UpdateCycle::glints_to_light(std::uint32_t samples) const {
    std::size_t turns = 1;
    if (dragged_ && !settings_.fixed_size) {
        const double wanted =
            seconds_a_glint_sample_ * samples * static_cast<double>(map_.glints.size());
        turns += static_cast<std::size_t>(wanted / (kGlintShare * seconds_budget()));
    }
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < map_.glints.size(); ++i)
        if (!map_.glints[i].lit || (i + statistics_.cycles) % turns == 0) chosen.push_back(i);
    return chosen;
}

}  // namespace chiaro
