#include "sample_selector/gain.h"

#include "base/tone_map.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// From the surplus of a patch's corners to that expected at its midpoints: between a smooth
// function (1/4) and a kink (1/2 to 1). The range counts for less: a gradient is no error.
constexpr float kSurplusNext = 0.35f;
constexpr float kRangeNext = 0.14f;

// A patch whose corners are partly buried holds a contact line, whose shading no corner shows.
constexpr float kContact = 0.25f;

// Error on the curve's scale of a patch of which next to nothing is known, its corners being
// buried.
constexpr float kUnseen = 0.2f;

// How much less a vertex that has found no light varies than one of the same samples that has.
constexpr float kDoubt = 4;

// New vertices a division makes on average, neighbours sharing the midpoints.
constexpr float kNewInFour = 3;
constexpr float kNewAcross = 1.5f;

// Samples that a new vertex may start with, and that any may take in all: variance is then far
// below what a display resolves.
constexpr std::uint32_t kMostOfNew = 4096;
constexpr std::uint32_t kMostSamples = 1u << 17;

// What the corners say together.
struct Corners {
    float light = 0;        // mean luminance of all channels that hold what this one does
    float picture = 0;      // mean luminance that the picture shows, on the curve's scale
    float low = kInfinity;  // range of the channel
    float high = -kInfinity;
    float surplus2 = 0;  // mean squared surplus of the channel
    float variance = 0;  // mean variance of the channel
    int buried = 0;
    int count = 0;
};

Corners survey(const ShadingCache& cache, const Patch& patch, int channel,
               const PictureScale& scale) {
    Corners c;
    c.count = patch.corner_count();
    c.buried = cache.buried_corners(patch);
    const float part = 1.0f / static_cast<float>(c.count);
    for (int i = 0; i < c.count; ++i) {
        const VertexId v = patch.corners[i];
        c.light += part * luminance(cache.shown_total(v, cache.shading(channel)).value);
        c.picture += part * scale.shown(cache, patch, v);
        const float value = luminance(cache.shown(v, channel).value);
        c.low = std::min(c.low, value);
        c.high = std::max(c.high, value);
        if (const Estimate* e = cache.estimate(v, channel); e && !cache.vertex(v).buried) {
            const float surplus = cache.surplus(v, channel);
            c.surplus2 += part * surplus * surplus;
            c.variance += part * e->variance;
        }
    }
    return c;
}

}  // namespace

bool on_front(const ShadingCache& cache, PatchId id, int channel) {
    const Patch& patch = cache.patch(id);
    if (patch.refined(channel)) return false;
    return patch.is_root() || cache.patch(static_cast<PatchId>(patch.parent)).refined(channel);
}

std::uint32_t samples_of_new(const ShadingCache& cache, PatchId id, int channel,
                             const GainSettings& settings) {
    const Patch& patch = cache.patch(id);
    std::uint32_t fewest = 0;
    for (int i = 0; i < patch.corner_count(); ++i)
        if (const Estimate* e = cache.estimate(patch.corners[i], channel))
            fewest = fewest == 0 ? e->samples : std::min<std::uint32_t>(fewest, e->samples);
    return std::clamp(fewest, settings.first_samples[channel], kMostOfNew);
}

Gain gain(const ShadingCache& cache, PatchId id, int channel, const GainSettings& settings) {
    const Patch& patch = cache.patch(id);
    const float pixels = cache.pixels(patch, channel);
    if (!(pixels > 0)) return {};
    const Corners corners = survey(cache, patch, channel, settings.scale);

    // Light to the scale on which errors are seen, linearised at the patch's mean.
    const float to_picture = cache.shading(channel) == Shading::glossy ? settings.scale.exposure
                                                                       : settings.scale.of(patch);
    const float slope = comparison_slope(corners.picture) * to_picture;

    Gain result;
    if (patch.fragment_count > 1 && patch.divisible()) {
        const float spread = corners.high - corners.low;
        float error2 =
            kSurplusNext * kSurplusNext * corners.surplus2 +
            kRangeNext * kRangeNext * std::max(0.0f, spread * spread - 9 * corners.variance);
        if (corners.buried > 0 && corners.buried < corners.count)
            error2 += kContact * kContact * corners.light * corners.light;
        float seen2 = error2 * slope * slope + settings.epsilon * settings.epsilon;
        if (corners.buried + 1 >= corners.count) seen2 += kUnseen * kUnseen;
        const bool across =
            patch.split == Split::quad_across_s || patch.split == Split::quad_across_t;
        const float points = across ? kNewAcross : kNewInFour;
        const float cost = points *
                           static_cast<float>(samples_of_new(cache, id, channel, settings)) *
                           settings.seconds_a_sample[channel];
        result.refine = seen2 * pixels / cost;
    }
    for (int i = 0; i < corners.count; ++i) {
        const Estimate* e = cache.estimate(patch.corners[i], channel);
        if (!e || e->samples >= kMostSamples) continue;
        float variance = e->variance;
        if (settings.zero_is_doubtful[channel] && max_component(e->mean) == 0)
            // As if one sample in this many found what lights the patch's other corners.
            variance = corners.light * corners.light / (kDoubt * static_cast<float>(e->samples));
        else if (cache.vertex(patch.corners[i]).buried)
            continue;
        const float cost = static_cast<float>(e->samples) * settings.seconds_a_sample[channel];
        // Half the variance would go at this corner; but it shows in all patches round it.
        const float drop = variance * slope * slope * pixels / cost;
        if (drop > result.resample) {
            result.resample = drop;
            result.noisiest = patch.corners[i];
        }
    }
    return result;
}

}  // namespace chiaro
