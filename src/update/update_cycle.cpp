#include "update/update_cycle.h"

#include "base/error.h"
#include "base/parallel.h"
#include "base/tone_map.h"
#include "scene/bsdf.h"
#include "update/glints.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace chiaro {
namespace {

// Light that is several dB off is seen before outlines are, whose rays take several times as long
// as those of the first picture. What goes into light before them: so many times these, but no more
// seconds than anyone would wait for.
constexpr double kMostSecondsBeforeOutlines = 0.5;
double seconds_before_outlines(double seconds_of_first_map) {
    constexpr double kTimes = 3;
    return std::min(kTimes * seconds_of_first_map, kMostSecondsBeforeOutlines);
}

// Whether the picture shows light that glossy surfaces' vertices are asked for.
bool shows_cached_gloss(const UpdateSettings& settings, const Scene& scene) {
    if (settings.aov == Aov::irradiance) return false;
    return std::any_of(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
        return widest_facets(m) >= settings.cached_facets;
    });
}

// The schemes' channels of irradiance and what their vertices start with.
std::vector<ChannelPlan> plan_irradiance(const UpdateSettings& settings, const Scene& scene) {
    if (settings.scheme == Scheme::paper)
        return {{Light::total, settings.direct_samples, settings.indirect_samples}};
    // Where anything shines and surfaces reflect at all, indirect light is everywhere but inside of
    // solids.
    bool reflects = false;
    for (const Material& m : scene.materials) reflects |= max_component(m.base_color) > 0;
    return {{.light = Light::direct, .first_samples = 32, .finds_buried = true},
            {.light = Light::indirect,
             .first_samples = 64,
             .finds_buried = true,
             .zero_is_buried = reflects && has_light(scene)}};
}

std::vector<ChannelPlan> plan_channels(const UpdateSettings& settings, const Scene& scene) {
    std::vector<ChannelPlan> plans = plan_irradiance(settings, scene);
    if (!shows_cached_gloss(settings, scene)) return plans;
    const bool paper = settings.scheme == Scheme::paper;
    // What few rays find makes most vertices darker than they are, and as sure of it; such noise
    // is taken for detail and divided down to the pixel (a varnished rail under lamps, by 32).
    plans.push_back({.light = Light::glossy,
                     .first_samples = paper ? settings.indirect_samples : 128,
                     .finds_buried = !paper});
    return plans;
}

Channels count_channels(std::span<const ChannelPlan> plans) {
    Channels count = {.irradiance = 0};
    for (const ChannelPlan& plan : plans)
        ++(plan.light == Light::glossy ? count.glossy : count.irradiance);
    return count;
}

float cost(const SampleCosts& costs, Light light) {
    switch (light) {
        case Light::direct:
            return costs.direct;
        case Light::glossy:
            return costs.glossy;
        default:
            return costs.indirect;
    }
}

// Which estimates count in predictions, by vertex: another number where that has changed.
std::vector<std::uint8_t> standing(const ShadingCache& cache, std::span<const VertexId> vertices) {
    std::vector<std::uint8_t> standing;
    standing.reserve(vertices.size());
    for (const VertexId v : vertices) {
        const int hollow = cache.hollow(v, Shading::irradiance) +
                           2 * (cache.has_glossy() && cache.hollow(v, Shading::glossy));
        standing.push_back(static_cast<std::uint8_t>(cache.vertex(v).buried + 2 * hollow));
    }
    return standing;
}

SplitRule split_rule(Scheme scheme) {
    return scheme == Scheme::paper ? SplitRule::always_four : SplitRule::by_shape;
}

}  // namespace

UpdateCycle::UpdateCycle(RayCaster& rays, const MeshGraphs& graphs, SampleRenderer& renderer,
                         OpenSides& open_sides, const UpdateSettings& settings)
    : rays_(&rays),
      renderer_(&renderer),
      open_sides_(&open_sides),
      settings_(settings),
      plans_(plan_channels(settings, rays.scene())),
      cache_(rays.scene(), graphs, count_channels(plans_), split_rule(settings.scheme)),
      environment_(!is_dark(rays.scene().environment)),
      rng_(settings.seed),
      front_(plans_.size()),
      news_(plans_.size()),
      seconds_a_polished_pixel_(kSecondsAPolishedPixel) {
    for (std::size_t c = 0; c < plans_.size(); ++c) {
        gains_.first_samples[c] = plans_[c].first_samples;
        // Before any costs were measured, and for good in cycles of fixed size.
        gains_.seconds_a_sample[c] = cost(renderer.typical_costs(), plans_[c].light);
    }
    follow_plans();
    gains_.scale.irradiance = settings.aov == Aov::irradiance;
    for (int c = 0; c < cache_.channels(); ++c) expected_.expect(rays.scene().objects.size(), c, 0);
}

bool UpdateCycle::lacks_channel() const {
    const std::vector<ChannelPlan> wanted = plan_channels(settings_, rays_->scene());
    return !std::ranges::all_of(wanted, [&](const ChannelPlan& plan) {
        return std::ranges::count(plans_, plan.light, &ChannelPlan::light) > 0;
    });
}

// The scene may be another. A channel that nothing needs any more stays: it may be needed again.
void UpdateCycle::follow_plans() {
    const std::vector<ChannelPlan> wanted = plan_channels(settings_, rays_->scene());
    for (std::size_t c = 0; c < plans_.size(); ++c) {
        for (const ChannelPlan& plan : wanted)
            if (plan.light == plans_[c].light) plans_[c] = plan;
        gains_.zero_is_doubtful[c] = plans_[c].zero_is_buried;
    }
}

void UpdateCycle::run() {
    check(view_.has_value(), "UpdateCycle: look_from() comes before run()");
    cycle_start_ = std::chrono::steady_clock::now();
    switch (stage_) {
        case Stage::new_view: {
            renew_map();
            const double seconds_of_map = seconds_since(cycle_start_);
            restart_polish();
            start();
            // While somebody drags a chair, every cycle is the first of a view.
            if (stale_.in_view > 0) refine_by_scheme();
            stage_ = Stage::covered;
            outlines_from_ =
                statistics_.seconds + seconds_since(cycle_start_) +
                (dragged_ ? kMostSecondsBeforeOutlines : seconds_before_outlines(seconds_of_map));
            break;
        }
        case Stage::covered:
            if (settings_.scheme == Scheme::best && !settings_.fixed_size &&
                statistics_.seconds < outlines_from_) {
                refine();
                break;
            }
            // The view rests: outlines and textures deserve more rays now.
            moving_ = dragged_ = false;
            if (map_quality_ != ViewQuality::antialiased) make_map(ViewQuality::antialiased);
            light_glints(kGlintSamples);
            restart_polish();
            start();
            stage_ = Stage::refining;
            break;
        default:
            refine_by_scheme();
            polish();
    }
    age();
    ++statistics_.cycles;
    statistics_.seconds += seconds_since(cycle_start_);
}

void UpdateCycle::refine_by_scheme() {
    settings_.scheme == Scheme::paper ? refine_as_paper() : refine();
}

ShadeWork UpdateCycle::new_work() const {
    return {plans_, settings_.seed, view_->eye(),
            in_haste() ? ShadeWork::kFewToBeDark : ShadeWork::kEnoughToBeDark};
}

void UpdateCycle::shade(ShadeWork& work) {
    const StepTimer timer(statistics_.timings, Step::rendering);
    for (int c = 0; c < cache_.channels(); ++c) {
        const std::vector<VertexId> new_ones = evaluated_first(work, c);
        const auto before = standing(cache_, work.vertices(c));
        const std::vector<float> stale = stale_light(work, c);
        const double seconds =
            work.shade(cache_, *renderer_, c, static_cast<Cycle>(statistics_.cycles));
        learn_change(work, c, stale);
        if (settings_.scheme == Scheme::best) {
            const auto suspects = mesh_front_.settle(cache_, new_ones, c, gains_);
            news_[c].insert(news_[c].end(), suspects.begin(), suspects.end());
            const auto now = standing(cache_, work.vertices(c));
            for (std::size_t i = 0; i < now.size(); ++i) {
                const VertexId v = work.vertices(c)[i];
                if (!cache_.vertex(v).of_mesh) continue;
                // One that is found buried or hollow, or not, speaks otherwise in all channels.
                for (int other = 0; other < cache_.channels(); ++other)
                    if (other == c || now[i] != before[i]) news_[other].push_back(v);
            }
        }
        statistics_.samples[c] += work.samples(c);
        if (settings_.fixed_size || work.samples(c) < 2000) continue;
        const double measured = seconds * threads_at_once() / static_cast<double>(work.samples(c));
        gains_.seconds_a_sample[c] +=
            cost_learning_ * (static_cast<float>(measured) - gains_.seconds_a_sample[c]);
    }
    statistics_.points_shaded += work.points();
    points_since_refresh_ += work.points();
    points_since_carry_ += work.points();
    // Where nothing was found, darkness is to be told from bad luck. Ends: samples double.
    ShadeWork doubts = work.doubts(cache_);
    if (doubts.points() > 0) shade(doubts);
}

// Vertices of meshes that the work evaluates for the first time in a channel, coarse ones first.
std::vector<VertexId> UpdateCycle::evaluated_first(const ShadeWork& work, int channel) const {
    std::vector<VertexId> vertices;
    for (const VertexId v : work.vertices(channel))
        if (cache_.vertex(v).of_mesh && !cache_.evaluated(v, channel)) vertices.push_back(v);
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

// Asking for more threads than there are processors makes nothing faster.
int UpdateCycle::threads_at_once() const {
    return std::min(settings_.threads, hardware_threads());
}

Image UpdateCycle::picture(const FadeIn* fade) {
    if (points_since_refresh_ > 0) cache_.resolve();
    Image picture = draw(cache_, map_, settings_.threads, fade);
    polish_.show(cache_, map_, settings_.threads, fade, picture);
    return picture;
}

// The scale on which errors are weighed: that of the pictures' comparison, from every few pixels.
void UpdateCycle::estimate_exposure() {
    const StepTimer timer(statistics_.timings, Step::sample_selection);
    constexpr std::size_t kPixels = 16384;
    const std::size_t step = std::max<std::size_t>(7, map_.background.pixels.size() / kPixels);
    Image thin(static_cast<int>(map_.first_of_pixel.size() / step), 1);
    for (std::size_t i = 0; i < thin.pixels.size(); ++i) {
        const auto pixel = static_cast<std::uint32_t>(step * i);
        thin.pixels[i] = map_.background.pixels[pixel];
        for (const Fragment& f : map_.at_pixel(pixel)) thin.pixels[i] += shown_by(cache_, f);
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
    make_map(map_quality_);
    light_glints(map_quality_ == ViewQuality::antialiased ? kGlintSamples : kGlintSamples / 4);
    // The view is the same, and so are its pixels: what passes have shown of them stays.
    if (polish_.size() != map_.chance_pixels.size()) restart_polish();
    attach_front();
    refresh(Extent::everything);
}

std::size_t UpdateCycle::bytes() const {
    std::size_t total = cache_.bytes() + polish_.bytes() + mesh_front_.bytes();
    for (const SumTree& tree : front_) total += tree.bytes();
    return total;
}

}  // namespace chiaro
