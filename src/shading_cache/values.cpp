// What vertices know and what they show: estimates merged as samples come, values carried from
// coarse to fine through the graph.

#include "base/error.h"
#include "base/rgb9e5.h"
#include "shading_cache/shading_cache.h"

#include <algorithm>
#include <cmath>

namespace chiaro {

void ShadingCache::store(VertexId id, int channel, Rgb mean, float variance, std::uint32_t samples,
                         Cycle now) {
    check(is_finite(mean) && std::isfinite(variance) && samples > 0, "store: value is not usable");
    std::uint32_t& slot = slots_[channel][index_of(id)];
    if (slot == kNoSlot) {
        slot = static_cast<std::uint32_t>(estimates_[channel].size());
        append(estimates_[channel],
               Estimate{mean, variance, first_surplus(id, channel, mean, variance),
                        std::min(samples, Estimate::kMostSamples) & Estimate::kMostSamples,
                        now & Estimate::kCycleMask});
    } else {
        // Batches are merged as if they were independent; parts of one Halton sequence do better
        // than that, so that the variance is not understated.
        Estimate& e = estimates_[channel][slot];
        const float old_part =
            static_cast<float>(e.samples) / static_cast<float>(e.samples + samples);
        const float new_part = 1 - old_part;
        e.mean = old_part * e.mean + new_part * mean;
        e.variance = old_part * old_part * e.variance + new_part * new_part * variance;
        e.samples = std::min(e.samples + samples, Estimate::kMostSamples) & Estimate::kMostSamples;
        e.shaded_at = now & Estimate::kCycleMask;
    }
    resolve_hollow(id);
    resolve_vertex(id, channel);
}

// By how much the prediction missed the first estimate, beyond what its noise explains. A vertex
// that happens to agree does not speak for its whole neighbourhood: a part of its parents' surplus
// stays suspected, less than the quarter that a smooth function would leave.
float ShadingCache::first_surplus(VertexId id, int channel, Rgb mean, float variance) const {
    const std::optional<Rgb> prediction = predicted(vertex(id), channel);
    if (!prediction) return Estimate::kUnknown;
    const float miss = luminance(mean) - luminance(*prediction);
    float inherited = 0;
    float noise = variance;
    for (int i = 0; i < 4 && vertex(id).parents[i] != VertexId::none; ++i) {
        const Estimate* e = estimate(vertex(id).parents[i], channel);
        if (!e) continue;
        const float weight = static_cast<float>(vertex(id).weights[i]) / CacheVertex::kFullWeight;
        noise += weight * weight * e->variance;
        inherited = std::max(inherited, surplus(vertex(id).parents[i], channel));
    }
    const float own = std::sqrt(std::max(0.0f, miss * miss - 3 * noise));
    return std::max(own, inherited / 16);
}

float ShadingCache::surplus(VertexId id, int channel) const {
    // A vertex that nothing predicted tells nothing of what lies around it.
    constexpr float kPartUnknown = 0.4f;
    const Estimate* e = estimate(id, channel);
    check(e != nullptr, "surplus: the vertex was not evaluated");
    if (e->surplus != Estimate::kUnknown) return e->surplus;
    return kPartUnknown * luminance(shown_total(id, shading(channel)).value);
}

void ShadingCache::mark_buried(VertexId id) {
    if (vertex(id).exposed) return;
    vertices_[index_of(id)].buried = 1;
    resolve_vertex(id);
}

void ShadingCache::unmark_buried(VertexId id) {
    if (!vertex(id).buried) return;
    vertices_[index_of(id)].buried = 0;
    resolve_vertex(id);
}

bool ShadingCache::dark(VertexId id) const {
    for (int c = 0; c < irradiance_channels_; ++c) {
        const Estimate* e = estimate(id, c);
        if (!e || max_component(e->mean) > 0) return false;
    }
    return true;
}

void ShadingCache::expose(VertexId id) {
    vertices_[index_of(id)].exposed = 1;
    unmark_buried(id);
}

int ShadingCache::buried_corners(const Patch& patch) const {
    int count = 0;
    for (int c = 0; c < patch.corner_count(); ++c) count += vertex(patch.corners[c]).buried ? 1 : 0;
    return count;
}

Shown ShadingCache::shown(VertexId id, int channel) const {
    return {unpack_rgb9e5(shown_[channel][index_of(id)]) * shown_unit_,
            vertex(id).hollow ? 0.0f : 1.0f};
}

Shown ShadingCache::shown_total(VertexId id, Shading shading) const {
    const bool glossy = shading == Shading::glossy;
    const int first = glossy ? irradiance_channels_ : 0;
    const int end = glossy ? channels() : irradiance_channels_;
    Shown total = {Rgb(0), vertex(id).hollow ? 0.0f : 1.0f};
    for (int c = first; c < end; ++c) total.value += shown(id, c).value;
    return total;
}

void ShadingCache::forget_glossy() {
    for (int c = irradiance_channels_; c < channels(); ++c) {
        std::fill(slots_[c].begin(), slots_[c].end(), kNoSlot);
        std::fill(shown_[c].begin(), shown_[c].end(), 0u);
        estimates_[c].clear();
        for (Patch& patch : patches_)
            patch.refined_channels &= static_cast<std::uint8_t>(~(1u << c));
    }
    for (std::size_t i = 0; i < vertices_.size(); ++i) resolve_hollow(static_cast<VertexId>(i));
}

// The parents' weighted mean, hollow ones left out; nothing if none is left.
std::optional<Rgb> ShadingCache::predicted(const CacheVertex& v, int channel) const {
    Rgb sum(0);
    int weight = 0;
    for (int i = 0; i < 4 && v.parents[i] != VertexId::none; ++i) {
        if (vertex(v.parents[i]).hollow) continue;
        sum += static_cast<float>(v.weights[i]) *
               unpack_rgb9e5(shown_[channel][index_of(v.parents[i])]);
        weight += v.weights[i];
    }
    if (weight == 0) return std::nullopt;
    return sum * (shown_unit_ / static_cast<float>(weight));
}

void ShadingCache::resolve_vertex(VertexId id, int channel) {
    const CacheVertex& v = vertex(id);
    const Estimate* e = v.buried ? nullptr : estimate(id, channel);
    const Rgb value = e ? e->mean : predicted(v, channel).value_or(Rgb(0));
    show(id, channel, value);
}

// The display's format reaches over 40 powers of two, lamps and starlight over more: its unit
// follows the brightest value, with room for a few brighter ones.
void ShadingCache::show(VertexId id, int channel, Rgb value) {
    constexpr float kMostUnits = 65408, kRoom = 0x1p-8f;
    if (max_component(value) > kMostUnits * shown_unit_) {
        const float unit =
            std::exp2(std::ceil(std::log2(max_component(value) / (kMostUnits * kRoom))));
        for (auto& array : shown_)
            for (std::uint32_t& bits : array)
                bits = pack_rgb9e5(unpack_rgb9e5(bits) * (shown_unit_ / unit));
        shown_unit_ = unit;
    }
    shown_[channel][index_of(id)] = pack_rgb9e5(value / shown_unit_);
}

void ShadingCache::resolve_hollow(VertexId id) {
    CacheVertex& v = vertices_[index_of(id)];
    bool knows = false;
    for (int c = 0; c < channels() && !v.buried; ++c) knows |= evaluated(id, c);
    for (int i = 0; i < 4 && v.parents[i] != VertexId::none; ++i)
        knows |= !vertex(v.parents[i]).hollow;
    v.hollow = knows ? 0 : 1;
}

void ShadingCache::resolve_vertex(VertexId id) {
    resolve_hollow(id);
    for (int c = 0; c < channels(); ++c) resolve_vertex(id, c);
}

void ShadingCache::resolve() {
    // Parents come earlier in the array than their children, so one pass is enough.
    for (std::size_t i = 0; i < vertices_.size(); ++i) resolve_vertex(static_cast<VertexId>(i));
}

}  // namespace chiaro
