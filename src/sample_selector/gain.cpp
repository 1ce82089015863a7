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

// And of a vertex of a mesh of which nothing is known at all: it shows black.
constexpr float kBlack = 0.5f;

// How much less a vertex that has found no light varies than one of the same samples that has.
constexpr float kDoubt = 4;

// kSurplusNext from a vertex of a mesh to those that it speaks for, which may face elsewhere.
constexpr float kSurplusOfMesh = 0.5f;

// Error on the curve's scale that is suspected at a vertex of a mesh that is not evaluated: its
// parents cannot know what is small (window blinds, gaps).
constexpr float kUnproven = 0.02f;

// The same at a corner of a patch of more than kMostToldByLevels fragments, but for gloss: few
// samples of that are farther off than levels are.
constexpr float kUnprovenAlone = 0.1f;

// The part of its parents that is to be evaluated before a vertex of a mesh is: not all, as some
// may be hidden, and are worth next to nothing themselves.
constexpr float kEnoughKnown = 0.5f;

// A patch of more fragments is not told of by how well coarser levels predicted its corners: these
// are no farther than it is wide. They count as corners that nothing predicted.
constexpr std::uint32_t kMostToldByLevels = 16;

// New vertices a division makes on average, neighbours sharing the midpoints.
constexpr float kNewInFour = 3;
constexpr float kNewAcross = 1.5f;

// Samples that a new vertex may start with, and that any may take in all: variance is then far
// below what a display resolves.
constexpr std::uint32_t kMostOfNew = 4096;
constexpr std::uint32_t kMostSamples = 1u << 17;

// What the vertices round a place say together: corners of a patch, parents of a vertex.
struct Survey {
    float light = 0;        // mean luminance of all channels that hold what this one does
    float low = kInfinity;  // range of the channel
    float high = -kInfinity;
    float surplus2 = 0;  // mean squared surplus of the channel
    float variance = 0;  // mean variance of the channel
    int buried = 0;
    int count = 0;

    void add(const ShadingCache& cache, VertexId v, int channel, float part,
             float least_surplus = 0) {
        ++count;
        buried += cache.vertex(v).buried ? 1 : 0;
        light += part * luminance(cache.shown_total(v, cache.shading(channel)).value);
        const float value = luminance(cache.shown(v, channel).value);
        low = std::min(low, value);
        high = std::max(high, value);
        if (const Estimate* e = cache.estimate(v, channel); e && !cache.vertex(v).buried) {
            const float surplus = std::max(cache.surplus(v, channel), least_surplus);
            surplus2 += part * surplus * surplus;
            variance += part * e->variance;
        }
    }

    // Squared error, in light, to expect between them, if surplus goes on by that factor.
    float error2(float surplus_next) const {
        const float spread = std::max(0.0f, high - low);  // of nothing: none
        float sum = surplus_next * surplus_next * surplus2 +
                    kRangeNext * kRangeNext * std::max(0.0f, spread * spread - 9 * variance);
        if (buried > 0 && buried < count) sum += kContact * kContact * light * light;
        return sum;
    }
};

// Light to the scale on which errors are seen, linearised where the picture shows `picture` on it.
float to_curve(const ShadingCache& cache, int channel, const PictureScale& scale,
               std::uint8_t reflectance, float picture) {
    const float to_picture =
        cache.shading(channel) == Shading::glossy ? scale.exposure : scale.of(reflectance);
    return comparison_slope(picture) * to_picture;
}

// The same at a vertex of the mesh.
float to_curve(const ShadingCache& cache, VertexId vertex, int channel, const PictureScale& scale) {
    const std::uint8_t reflectance = cache.reflectance(vertex);
    const float picture =
        scale.of(reflectance) * luminance(cache.shown_total(vertex).value) +
        scale.exposure * luminance(cache.shown_total(vertex, Shading::glossy).value);
    return to_curve(cache, channel, scale, reflectance, picture);
}

// Gain of evaluating a patch's midpoints, a pixel.
float gain_of_refining(const Survey& corners, const Patch& patch, float slope, int channel,
                       std::uint32_t of_new, const GainSettings& settings) {
    if (patch.fragment_count <= 1 || !patch.divisible()) return 0;
    float seen2 =
        corners.error2(kSurplusNext) * slope * slope + settings.epsilon * settings.epsilon;
    if (corners.buried + 1 >= corners.count) seen2 += kUnseen * kUnseen;
    const bool across = patch.split == Split::quad_across_s || patch.split == Split::quad_across_t;
    const float points = across ? kNewAcross : kNewInFour;
    return seen2 / (points * static_cast<float>(of_new) * settings.seconds_a_sample[channel]);
}

// What as many samples again cost, or those that take the place of stale ones.
float seconds_of_more(const Estimate& e, int channel, std::uint32_t of_new,
                      const GainSettings& settings) {
    const std::uint32_t samples =
        e.stale ? samples_of_stale(e, channel, of_new, settings) : e.samples;
    return static_cast<float>(samples) * settings.seconds_a_sample[channel];
}

std::uint32_t samples_of_new(const ShadingCache& cache, std::span<const VertexId> around,
                             int channel, const GainSettings& settings) {
    std::uint32_t fewest = 0;
    for (const VertexId vertex : around) {
        const Estimate* e = cache.estimate(vertex, channel);
        // Buried ones are not sampled on, however much those round them are.
        if (!e || e->stale || cache.vertex(vertex).buried) continue;
        fewest = fewest == 0 ? e->samples : std::min<std::uint32_t>(fewest, e->samples);
    }
    return std::clamp(fewest, settings.first_samples[channel], kMostOfNew);
}

}  // namespace

std::uint32_t samples_of_stale(const Estimate& stale, int channel, std::uint32_t of_new,
                               const GainSettings& settings) {
    constexpr std::uint32_t kTimes = 4;
    const std::uint32_t least = std::max(of_new, kTimes * settings.first_samples[channel]);
    return std::clamp(kTimes * stale.samples, least, std::max(least, kMostOfNew));
}

bool told_by_levels(const Patch& patch) {
    return patch.fragment_count <= kMostToldByLevels;
}

bool on_front(const ShadingCache& cache, PatchId id, int channel) {
    const Patch& patch = cache.patch(id);
    if (patch.refined(channel)) return false;
    return patch.is_root() || cache.patch(static_cast<PatchId>(patch.parent)).refined(channel);
}

std::uint32_t samples_of_new(const ShadingCache& cache, PatchId id, int channel,
                             const GainSettings& settings) {
    const Patch& patch = cache.patch(id);
    return samples_of_new(cache, std::span(patch.corners).first(patch.corner_count()), channel,
                          settings);
}

Gain gain(const ShadingCache& cache, PatchId id, int channel, const GainSettings& settings) {
    const Patch& patch = cache.patch(id);
    const float pixels = cache.pixels(patch, channel);
    if (!(pixels > 0)) return {};
    // Corners that are predicted from coarser levels come first (MeshFront).
    for (int i = 0; i < patch.corner_count(); ++i)
        if (!cache.evaluated(patch.corners[i], channel)) return {};

    Survey corners;
    float picture = 0;
    const float part = 1.0f / static_cast<float>(patch.corner_count());
    for (int i = 0; i < patch.corner_count(); ++i) {
        const VertexId corner = patch.corners[i];
        const bool alone = cache.vertex(corner).of_mesh && !told_by_levels(patch);
        corners.add(cache, corner, channel, part,
                    alone ? cache.surplus_of_unknown(corner, channel) : 0);
        picture += part * settings.scale.shown(cache, patch, patch.corners[i]);
    }
    const float slope = to_curve(cache, channel, settings.scale, patch.reflectance, picture);

    Gain result;
    const std::uint32_t of_new = samples_of_new(cache, id, channel, settings);
    result.refine = gain_of_refining(corners, patch, slope, channel, of_new, settings) * pixels;
    bool any_stale = false;
    for (int i = 0; i < corners.count; ++i) {
        const Estimate* e = cache.estimate(patch.corners[i], channel);
        if (!e || e->samples >= kMostSamples) continue;
        const bool doubtful = settings.zero_is_doubtful[channel] && max_component(e->mean) == 0;
        if (cache.vertex(patch.corners[i]).buried && !doubtful) continue;
        float variance = doubtful && !e->stale ? 0.0f : static_cast<float>(e->variance);
        if (doubtful)
            // As if one sample in this many found what lights the patch's other corners.
            variance = std::max(variance, corners.light * corners.light /
                                              (kDoubt * static_cast<float>(e->samples)));
        const float cost = seconds_of_more(*e, channel, of_new, settings);
        // Half the variance would go at this corner; but it shows in all patches round it.
        const float drop = variance * slope * slope * pixels / cost;
        if (any_stale && !e->stale) continue;
        if (drop > result.resample || (e->stale && !any_stale)) {
            result.resample = drop;
            result.noisiest = patch.corners[i];
        }
        any_stale |= e->stale;
    }
    // A difference between what is and what was tells nothing of what lies between.
    if (any_stale) {
        result.resample = result.best();
        result.refine = 0;
    }
    return result;
}

std::uint32_t samples_of_new(const ShadingCache& cache, VertexId vertex, int channel,
                             const GainSettings& settings) {
    return samples_of_new(cache, cache.parents(vertex).vertices(), channel, settings);
}

float gain_of_first(const ShadingCache& cache, VertexId vertex, int channel, const OnVertex& on_it,
                    const GainSettings& settings) {
    const Parents parents = cache.parents(vertex);
    const float cost = static_cast<float>(samples_of_new(cache, vertex, channel, settings)) *
                       settings.seconds_a_sample[channel];
    if (cache.hollow(vertex, cache.shading(channel))) return kBlack * kBlack * on_it.pixels / cost;

    float known = 0;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (cache.evaluated(parents[i], channel)) known += parents.weight(i);
    if (known < kEnoughKnown && on_it.told_by_levels) return 0;

    Survey survey;
    for (std::size_t i = 0; i < parents.size(); ++i)
        if (cache.evaluated(parents[i], channel))
            survey.add(cache, parents[i], channel, parents.weight(i) / known);
    const float slope = to_curve(cache, vertex, channel, settings.scale);
    const bool alone = !on_it.told_by_levels && cache.shading(channel) == Shading::irradiance;
    const float unproven = alone ? kUnprovenAlone : kUnproven;
    const float error2 = survey.error2(kSurplusOfMesh) * slope * slope + unproven * unproven;
    return error2 * on_it.pixels / cost;
}

float gain_of_more(const ShadingCache& cache, VertexId vertex, int channel, float pixels,
                   const GainSettings& settings) {
    const Estimate* e = cache.estimate(vertex, channel);
    if (!e || e->samples >= kMostSamples || cache.vertex(vertex).buried) return 0;
    const float slope = to_curve(cache, vertex, channel, settings.scale);
    const std::uint32_t of_new = samples_of_new(cache, vertex, channel, settings);
    const float cost = seconds_of_more(*e, channel, of_new, settings);
    return e->variance * slope * slope * pixels / cost;
}

}  // namespace chiaro
