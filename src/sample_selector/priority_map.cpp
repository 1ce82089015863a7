#include "sample_selector/priority_map.h"

#include "base/random.h"
#include "base/tone_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chiaro {
namespace {

// A patch that is not in view is taken to show its irradiance.
bool counts(const ShadingCache& cache, const Patch& patch, Shading shading) {
    if (shading == Shading::glossy) return cache.has_glossy() && patch.glossy_pixels > 0;
    return patch.pixels > 0 || !(patch.glossy_pixels > 0);
}

// What a fragment adds to its pixel, a surface's glossy radiance taken to be what its diffuse is.
float weight_of(const Fragment& f) {
    return luminance(f.reflectance + f.gloss * (1 / kPi));
}

PatchId choose_leaf(std::span<const Fragment> fragments, float u) {
    if (fragments.size() == 1) return fragments.front().patch;
    float rest = 0;
    for (const Fragment& f : fragments) rest += weight_of(f);
    rest *= u;
    for (const Fragment& f : fragments) {
        rest -= weight_of(f);
        if (rest < 0) return f.patch;
    }
    return fragments.back().patch;
}

}  // namespace

Rgb PictureScale::color(const ShadingCache& cache, const Patch& patch, VertexId corner) const {
    Rgb sum(0);
    if (counts(cache, patch, Shading::irradiance))
        sum += of(patch) * cache.shown_total(corner).value;
    if (counts(cache, patch, Shading::glossy))
        sum += exposure * cache.shown_total(corner, Shading::glossy).value;
    return sum;
}

float interpolation_error(const ShadingCache& cache, const Patch& leaf,
                          const PictureScale& picture) {
    float low = kInfinity;
    float high = -kInfinity;
    for (int c = 0; c < leaf.corner_count(); ++c) {
        for (int channel = 0; channel < cache.channels(); ++channel)
            if (counts(cache, leaf, cache.shading(channel)) &&
                !cache.evaluated(leaf.corners[c], channel))
                return 1;
        const float tone = paper_tone_value(picture.color(cache, leaf, leaf.corners[c]), 1);
        low = std::min(low, tone);
        high = std::max(high, tone);
    }
    return high - low;
}

float age_priority(const ShadingCache& cache, const Patch& leaf, const Aging& aging) {
    if (aging.rates.empty()) return 0;
    Cycle age = 0;
    for (int c = 0; c < leaf.corner_count(); ++c)
        for (int channel = 0; channel < cache.channels(); ++channel) {
            const Estimate* e = cache.estimate(leaf.corners[c], channel);
            if (e && e->stale)
                age = std::max(age, (aging.now - e->shaded_at) & Estimate::kCycleMask);
        }
    if (age == 0) return 0;
    const ObjectId object = cache.surface_point(leaf.corners[0]).object;
    return aging.rates[index_of(object)] * static_cast<float>(age);
}

PriorityMap make_priority_map(const ShadingCache& cache, const IdMap& map,
                              const PictureScale& scale, std::uint32_t turn, const Aging& aging) {
    PriorityMap result;
    result.width = map.width;
    result.height = map.height;
    const std::size_t pixels = static_cast<std::size_t>(map.width) * map.height;
    result.patches.assign(pixels, PatchId::none);
    result.pixel_priorities.assign(pixels, 0.0f);

    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> by_patch(cache.patches().size(), kUnknown);
    for (std::uint32_t p = 0; p < pixels; ++p) {
        const auto fragments = map.at_pixel(p);
        if (fragments.empty()) continue;
        const PatchId leaf = choose_leaf(fragments, to_unit_float(hash32(turn, p)));
        float& priority = by_patch[index_of(leaf)];
        if (std::isnan(priority)) {
            priority = interpolation_error(cache, cache.patch(leaf), scale) +
                       age_priority(cache, cache.patch(leaf), aging);
            result.patch_priorities.push_back(priority);
        }
        result.patches[p] = leaf;
        result.pixel_priorities[p] = priority;
    }
    return result;
}

float PriorityRange::normalize(float priority) const {
    if (low == high) return 0.5f;
    return std::clamp((priority - low) / (high - low), 0.0f, 1.0f);
}

PriorityRange four_sigma_range(std::span<const float> patch_priorities) {
    const double count = static_cast<double>(patch_priorities.size());
    double mean = 0;
    for (const float p : patch_priorities) mean += p / count;
    double variance = 0;
    for (const float p : patch_priorities) variance += (p - mean) * (p - mean) / count;
    const double reach = 4 * std::sqrt(variance);
    return {static_cast<float>(mean - reach), static_cast<float>(mean + reach)};
}

}  // namespace chiaro
