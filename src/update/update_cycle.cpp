#include "update/update_cycle.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/tone_map.h"
#include "shading_cache/interpolate.h"
#include "update/start_level.h"

#include <algorithm>
#include <chrono>

namespace chiaro {
namespace {

// The best scheme's channels and what their vertices start with.
std::vector<ChannelPlan> plan_channels(const UpdateSettings& settings, const Scene& scene) {
    if (settings.scheme == Scheme::paper)
        return {{Light::total, settings.direct_samples, settings.indirect_samples}};
    // Where surfaces reflect at all, indirect light is everywhere but inside of solids.
    bool reflects = false;
    for (const Material& m : scene.materials) reflects |= max_component(m.base_color) > 0;
    return {{.light = Light::direct, .first_samples = 32, .finds_buried = true},
            {.light = Light::indirect,
             .first_samples = 64,
             .finds_buried = true,
             .zero_is_buried = reflects}};
}

// A cycle of fixed size asks for about as much as this.
constexpr double kFixedFirstPictureSeconds = 0.15;

// Direct light's part of the first picture's time, and how many times the planned samples a vertex
// of the first picture may have.
constexpr double kDirectShare = 0.15;
constexpr std::uint32_t kMostFirstSamples = 4;

SplitRule split_rule(Scheme scheme) {
    return scheme == Scheme::paper ? SplitRule::always_four : SplitRule::by_shape;
}

}  // namespace

UpdateCycle::UpdateCycle(const RayCaster& rays, SampleRenderer& renderer, OpenSides& open_sides,
                         const UpdateSettings& settings)
    : rays_(&rays),
      renderer_(&renderer),
      open_sides_(&open_sides),
      settings_(settings),
      plans_(plan_channels(settings, rays.scene())),
      cache_(rays.scene(), static_cast<int>(plans_.size()), split_rule(settings.scheme)),
      rng_(settings.seed),
      front_(plans_.size()) {
    for (std::size_t c = 0; c < plans_.size(); ++c) {
        gains_.first_samples[c] = plans_[c].first_samples;
        // Before any costs were measured, and for good in cycles of fixed size.
        const SampleCosts costs = renderer.typical_costs();
        gains_.seconds_a_sample[c] =
            plans_[c].light == Light::direct ? costs.direct : costs.indirect;
        gains_.zero_is_doubtful[c] = plans_[c].zero_is_buried;
    }
    gains_.scale.irradiance = settings.aov == Aov::irradiance;
}

void UpdateCycle::look_from(const View& view) {
    view_ = view;
    stage_ = Stage::new_view;
}

void UpdateCycle::run() {
    check(view_.has_value(), "UpdateCycle: look_from() comes before run()");
    const auto start_time = std::chrono::steady_clock::now();
    switch (stage_) {
        case Stage::new_view:
            make_map(ViewQuality::one_ray);
            start();
            stage_ = Stage::covered;
            break;
        case Stage::covered:
            // The view rests: outlines and textures deserve more rays now.
            make_map(ViewQuality::antialiased);
            start();
            stage_ = Stage::refining;
            break;
        default:
            settings_.scheme == Scheme::paper ? refine_as_paper() : refine();
    }
    age();
    ++statistics_.cycles;
    statistics_.seconds +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_time).count();
}

void UpdateCycle::make_map(ViewQuality quality) {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    map_ = make_id_map(cache_, *rays_, *view_, {quality, settings_.aov, settings_.threads},
                       open_sides_);
    attach(cache_, map_, static_cast<Cycle>(statistics_.cycles));
}

// Everything in view, at an even density that the first picture's budget can pay. The paper's
// scheme evaluates the roots as they are.
void UpdateCycle::start() {
    ShadeWork work(plans_, settings_.seed);
    std::vector<std::uint32_t> samples(plans_.size(), 0);
    if (settings_.scheme == Scheme::best) {
        const StepTimer timer(statistics_.timings, Step::patch_subdivision);
        const double seconds = settings_.fixed_size
                                   ? kFixedFirstPictureSeconds
                                   : settings_.first_picture_seconds * threads_at_once();
        for (int c = 0; c < cache_.channels(); ++c) samples[c] = even_out_channel(c, seconds);
    }
    {
        const StepTimer timer(statistics_.timings, Step::sample_selection);
        evaluate_in_view(cache_, samples, work);
    }
    shade(work);
    if (settings_.scheme == Scheme::best) dig_out();
    estimate_exposure();
    refresh();
}

// A face whose corners all lie in its neighbours would be black: divides such patches at once,
// until something of them is known.
void UpdateCycle::dig_out() {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    constexpr int kMostRounds = 8;
    for (int round = 0; round < kMostRounds; ++round) {
        ShadeWork work(plans_, settings_.seed);
        touched_.clear();
        for (int c = 0; c < cache_.channels(); ++c)
            for (const PatchId patch : dug_in(cache_, c)) divide(patch, c, work);
        if (work.points() == 0) break;
        shade(work);
    }
    for (std::size_t i = 0; i < cache_.patches().size(); ++i)
        expose_if_seen(cache_, static_cast<PatchId>(i));
}

// Divides patches until a channel's share of the first picture's seconds is used, and returns with
// how many samples its vertices start: more than the plan says where few vertices are needed, since
// noise is seen before interpolation is.
std::uint32_t UpdateCycle::even_out_channel(int channel, double seconds) {
    const double share =
        seconds * (plans_[channel].light == Light::direct ? kDirectShare : 1 - kDirectShare);
    const auto affordable = [&](std::uint32_t samples) {
        return share / (samples * static_cast<double>(gains_.seconds_a_sample[channel]));
    };
    std::uint32_t samples = plans_[channel].first_samples * kMostFirstSamples;
    const auto now = static_cast<Cycle>(statistics_.cycles);
    even_out(cache_, map_, channel, static_cast<std::size_t>(affordable(samples)), now);
    const auto missing = static_cast<double>(missing_in_view(cache_, channel));
    while (samples > plans_[channel].first_samples && affordable(samples) < missing) samples /= 2;
    return samples;
}

void UpdateCycle::shade(ShadeWork& work) {
    const StepTimer timer(statistics_.timings, Step::rendering);
    for (int c = 0; c < cache_.channels(); ++c) {
        const double seconds =
            work.shade(cache_, *renderer_, c, static_cast<Cycle>(statistics_.cycles));
        statistics_.samples[c] += work.samples(c);
        if (settings_.fixed_size || work.samples(c) < 2000) continue;
        const double measured = seconds * threads_at_once() / static_cast<double>(work.samples(c));
        gains_.seconds_a_sample[c] +=
            0.2f * (static_cast<float>(measured) - gains_.seconds_a_sample[c]);
    }
    statistics_.points_shaded += work.points();
    points_since_refresh_ += work.points();
    // Where nothing was found, darkness is to be told from bad luck. Ends: samples double.
    ShadeWork doubts = work.doubts(cache_);
    if (doubts.points() > 0) shade(doubts);
}

// Asking for more threads than there are processors makes nothing faster.
int UpdateCycle::threads_at_once() const {
    return std::min(settings_.threads, hardware_threads());
}

Image UpdateCycle::picture() {
    if (points_since_refresh_ > 0) cache_.resolve();
    return draw(cache_, map_, settings_.threads);
}

// The scale on which errors are weighed: that of the pictures' comparison, from every few pixels.
void UpdateCycle::estimate_exposure() {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    Image thin(static_cast<int>(map_.first_of_pixel.size() / 7), 1);
    for (std::size_t i = 0; i < thin.pixels.size(); ++i) {
        const auto pixel = static_cast<std::uint32_t>(7 * i);
        thin.pixels[i] = map_.background.pixels[pixel];
        for (const Fragment& f : map_.at_pixel(pixel))
            thin.pixels[i] += f.reflectance * irradiance_at(cache_, f.patch, f.local);
    }
    gains_.scale.exposure = comparison_exposure(thin);
    points_at_exposure_ = statistics_.points_shaded;
}

void UpdateCycle::age() {
    const StepTimer timer(statistics_.timings, Step::aging);
    const auto now = static_cast<Cycle>(statistics_.cycles);
    if (!age_out(cache_, settings_.aging, now)) return;
    // All ids have changed: look again.
    for (SumTree& tree : front_) tree.clear();
    make_map(ViewQuality::antialiased);
    refresh();
}

std::size_t UpdateCycle::bytes() const {
    std::size_t total = cache_.bytes();
    for (const SumTree& tree : front_) total += tree.bytes();
    return total;
}

}  // namespace chiaro
