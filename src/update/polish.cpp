// What polish shows by chance: passes that go on while the view rests.

#include "sample_selector/gain.h"
#include "update/glints.h"
#include "update/update_cycle.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_set>

namespace chiaro {
namespace {

// Of a cycle's time, for passes over polish.
constexpr double kPolishShare = 0.1;

}  // namespace

double UpdateCycle::polish_share() const {
    return map_.chance_pixels.empty() ? 0 : kPolishShare;
}

// What the first pass finds counts until the third is through: before it the cache is refined for
// a while.
void UpdateCycle::restart_polish() {
    constexpr double kPassesToWait = 0.25, kCyclesToWait = 8;
    polish_.restart(map_.chance_pixels.size());
    const double a_pass = seconds_a_polished_pixel_ * static_cast<double>(polish_.size());
    polish_credit_ =
        -std::max(kPassesToWait * a_pass, kCyclesToWait * kPolishShare * seconds_budget());
}

// Time that a pass needed beyond its cycle's share is taken from the cycles after it.
void UpdateCycle::polish() {
    if (map_.chance_pixels.empty()) return;
    polish_credit_ += kPolishShare * seconds_budget();
    while (polish_credit_ > 0) {
        const std::size_t left = map_.chance_pixels.size() - polish_.next();
        const double affordable = std::ceil(polish_credit_ / seconds_a_polished_pixel_);
        polish_credit_ -=
            polish_pixels(std::min(left, static_cast<std::size_t>(std::min(affordable, 1e9))));
    }
}

// Goes on with the pass by so many pixels. Returns the processor seconds that it took.
double UpdateCycle::polish_pixels(std::size_t count) {
    const auto start = std::chrono::steady_clock::now();
    ChancePass seen;
    ShadeWork work = new_work();
    {
        const StepTimer timer(statistics_.timings, Step::sample_selection);
        const auto pixels = std::span(map_.chance_pixels).subspan(polish_.next(), count);
        seen = look_again(cache_, *rays_, *view_, view_settings(), pixels, polish_.pass());
        for (const auto& [vertex, channel] : cache_.take_forgotten()) {
            mesh_front_.unsettle(cache_, vertex, channel, gains_);
            news_[channel].push_back(vertex);
        }
        for (Fragment& f : seen.fragments) hand_to_leaf(cache_, f);
        light_surfaces(seen.fragments, work);
    }
    if (work.points() > 0) {
        shade(work);
        const StepTimer timer(statistics_.timings, Step::update_display_meshes);
        cache_.resolve();
    }
    std::vector<Rgb> light = seen.light;
    light_pixels(seen, light);
    polish_.add(light);

    if (settings_.fixed_size)
        return static_cast<double>(count) * kSecondsAPolishedPixel + work_seconds(work);
    const double seconds = seconds_since(start) * threads_at_once();
    // What was dearer than expected counts at once, so that no cycle is much too long twice.
    const double a_pixel = seconds / static_cast<double>(count);
    double& known = seconds_a_polished_pixel_;
    known = std::max(a_pixel, known + 0.2 * (a_pixel - known));
    return seconds;
}

// Chance finds surfaces that the map does not show. What their vertices show is predicted from
// coarser ones; those that nothing predicts are evaluated, and those that an edit has outdated are
// sampled again, as nobody else comes to those out of view.
void UpdateCycle::light_surfaces(std::span<const Fragment> fragments, ShadeWork& work) {
    std::unordered_set<std::uint64_t> met;
    const auto light = [&](const auto& again, VertexId id, int channel) -> void {
        const Estimate* e = cache_.estimate(id, channel);
        if (e && !e->stale) return;
        if (!met.insert(index_of(id) * 8 + static_cast<std::uint64_t>(channel)).second) return;
        if (e) {
            resample(id, channel, samples_of_new(cache_, id, channel, gains_), work);
            return;
        }
        const Parents parents = cache_.parents(id);
        bool known = true;
        for (const VertexId parent : parents) known &= cache_.evaluated(parent, channel);
        // Meshes that it finds are known a level better after every pass.
        if (cache_.vertex(id).of_mesh && known) work.evaluate(cache_, id, channel);
        for (const VertexId parent : parents) again(again, parent, channel);
    };
    for (const Fragment& f : fragments)
        for (int channel = 0; channel < cache_.channels(); ++channel) {
            if (cache_.shading(channel) != Shading::irradiance) continue;
            const Patch& patch = cache_.patch(f.patch);
            for (int c = 0; c < patch.corner_count(); ++c) light(light, patch.corners[c], channel);
        }
}

// Adds what the surfaces reflect and what the glints show of lights. A pixel's first glint, which
// most pixels have alone, goes on with one sequence from pass to pass.
void UpdateCycle::light_pixels(const ChancePass& seen, std::span<Rgb> light) {
    for (const Fragment& f : seen.fragments) light[f.pixel] += shown_by(cache_, f);

    const StepTimer timer(statistics_.timings, Step::rendering);
    const std::uint32_t session = hash64(settings_.seed);
    std::vector<ShadeRequest> requests;
    requests.reserve(seen.glints.size());
    std::uint32_t place = 0;  // among its pixel's
    for (std::size_t i = 0; i < seen.glints.size(); ++i) {
        const Glint& glint = seen.glints[i];
        place = i > 0 && seen.glints[i - 1].pixel == glint.pixel ? place + 1 : 0;
        const std::uint32_t pixel = map_.chance_pixels[polish_.next() + glint.pixel].pixel;
        ShadeRequest request = glint_request(glint, hash32(session, ~pixel), kGlintSamples);
        request.seed = hash32(request.seed, request.samples);
        if (place == 0)
            request.first_sample = (polish_.pass() - 1) * request.samples;
        else
            request.seed = hash32(hash32(request.seed, place), polish_.pass());
        requests.push_back(request);
    }
    std::vector<ShadeResult> results(requests.size());
    renderer_->shade(requests, results);
    for (std::size_t i = 0; i < results.size(); ++i)
        light[seen.glints[i].pixel] += seen.glints[i].weight * results[i].mean;
}

}  // namespace chiaro
