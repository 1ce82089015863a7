// What vertices know and what they show: estimates merged as samples come, values carried from
// coarse to fine through the graph.

#include "base/error.h"
#include "base/rgb9e5.h"
#include "shading_cache/shading_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace chiaro {

void ShadingCache::store(VertexId id, int channel, Rgb mean, float variance, std::uint32_t samples,
                         Cycle now) {
    check(is_finite(mean) && std::isfinite(variance) && samples > 0, "store: value is not usable");
    if (Estimate* known = estimates_.find(id, channel); known == nullptr) {
        estimates_.add(id, channel,
                       {mean, variance, first_surplus(id, channel, mean, variance),
                        std::min(samples, Estimate::kMostSamples) & Estimate::kMostSamples,
                        now & Estimate::kCycleMask});
    } else {
        // Batches are merged as if they were independent; parts of one Halton sequence do better
        // than that, so that the variance is not understated.
        Estimate& e = *known;
        if (e.stale) e.samples = 0;
        const float old_part =
            static_cast<float>(e.samples) / static_cast<float>(e.samples + samples);
        const float new_part = 1 - old_part;
        e.mean = old_part * e.mean + new_part * mean;
        e.variance = old_part * old_part * e.variance + new_part * new_part * variance;
        e.samples = std::min(e.samples + samples, Estimate::kMostSamples) & Estimate::kMostSamples;
        e.shaded_at = now & Estimate::kCycleMask;
        const float surplus = first_surplus(id, channel, e.mean, e.variance);
        // More samples tell what of it was noise.
        if (e.stale)
            e.surplus = surplus;
        else if (e.surplus != Estimate::kUnknown)
            e.surplus = std::min<float>(e.surplus, surplus);
        e.stale = 0;
    }
    resolve_hollow(id);
    resolve_vertex(id, channel);
    note_change(id, channel);  // its variance and surplus are news even where its value is not
}

// By how much the prediction missed the first estimate, beyond what its noise explains. A vertex
// that happens to agree does not speak for its whole neighbourhood: a part of its parents' surplus
// stays suspected: the quarter that a smooth function would leave on a mesh, whose vertices differ
// in more than place, less below it.
float ShadingCache::first_surplus(VertexId id, int channel, Rgb mean, float variance) const {
    const std::optional<Rgb> prediction = predicted(id, channel);
    if (!prediction) return Estimate::kUnknown;
    const float miss = luminance(mean) - luminance(*prediction);
    float inherited = 0;
    float noise = variance;
    const Parents parents = this->parents(id);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const Estimate* e = estimate(parents[i], channel);
        if (!e) continue;
        const float weight = parents.weight(i);
        noise += weight * weight * e->variance;
        inherited = std::max(inherited, surplus(parents[i], channel));
    }
    const float own = std::sqrt(std::max(0.0f, miss * miss - 3 * noise));
    return std::max(own, inherited / (vertex(id).of_mesh ? 4 : 16));
}

float ShadingCache::surplus(VertexId id, int channel) const {
    const Estimate* e = estimate(id, channel);
    check(e != nullptr, "surplus: the vertex was not evaluated");
    if (e->surplus != Estimate::kUnknown) return e->surplus;
    return surplus_of_unknown(id, channel);
}

float ShadingCache::surplus_of_unknown(VertexId id, int channel) const {
    constexpr float kPart = 0.4f;
    return kPart * luminance(shown_total(id, shading(channel)).value);
}

bool ShadingCache::suspect(VertexId id, int channel, float luminance) {
    Estimate& e = *estimates_.find(id, channel);
    if (luminance <= surplus(id, channel)) return false;
    e.surplus = luminance;
    note_change(id, channel);
    return true;
}

void ShadingCache::outdate(VertexId id, int channel, float error2) {
    Estimate* e = estimates_.find(id, channel);
    if (!e) return;
    // As many samples as would leave that error, in powers of two.
    const float samples = static_cast<float>(e->samples) * e->variance;
    e->variance = e->stale ? error2 : e->variance + error2;
    constexpr float kMost = static_cast<float>(std::bit_floor(Estimate::kMostSamples));
    const float worth = std::clamp(samples / std::max<float>(e->variance, 1e-30f), 1.0f, kMost);
    e->samples = std::bit_floor(static_cast<std::uint32_t>(worth)) & Estimate::kMostSamples;
    e->stale = 1;
    note_change(id, channel);
}

void ShadingCache::forget(VertexId id, std::uint8_t channels) {
    if ((estimates_.known(id) & channels) == 0) return;
    note_forgotten(id, channels);
    estimates_.forget(id, channels);
    resolve_vertex(id);
}

void ShadingCache::forget(VertexId id) {
    note_forgotten(id, kAllChannels);
    estimates_.forget(id, kAllChannels);
    vertices_[index_of(id)].exposed = 0;
    set_buried(id, false);
}

void ShadingCache::note_forgotten(VertexId id, std::uint8_t channels) {
    for (int c = 0; c < this->channels(); ++c)
        if (channels >> c & 1 && evaluated(id, c)) forgotten_.emplace_back(id, c);
}

void ShadingCache::mark_buried(VertexId id) {
    if (!vertex(id).exposed) set_buried(id, true);
}

void ShadingCache::unmark_buried(VertexId id) {
    if (vertex(id).buried) set_buried(id, false);
}

// Its children believe it more or less than before, in all channels, whatever it shows.
void ShadingCache::set_buried(VertexId id, bool buried) {
    vertices_[index_of(id)].buried = buried ? 1 : 0;
    resolve_vertex(id);
    for (int c = 0; c < channels(); ++c) note_change(id, c);
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
    return {unpack_rgb9e5(shown_[channel].of(id)) * shown_unit_,
            hollow(id, shading(channel)) ? 0.0f : 1.0f};
}

ShadingCache::ChannelRange ShadingCache::channels_of(Shading shading) const {
    if (shading == Shading::irradiance) return {0, irradiance_channels_};
    return {irradiance_channels_, channels()};
}

Shown ShadingCache::shown_total(VertexId id, Shading shading) const {
    Shown total = {Rgb(0), hollow(id, shading) ? 0.0f : 1.0f};
    const ChannelRange range = channels_of(shading);
    for (int c = range.first; c < range.end; ++c) total.value += shown(id, c).value;
    return total;
}

void ShadingCache::forget_glossy() {
    const auto glossy = static_cast<std::uint8_t>(kAllChannels << irradiance_channels_);
    for (Patch& patch : patches_) patch.refined_channels &= static_cast<std::uint8_t>(~glossy);
    for (int c = irradiance_channels_; c < channels(); ++c) shown_[c].clear_values();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        estimates_.forget(static_cast<VertexId>(i), glossy);
        resolve_hollow(static_cast<VertexId>(i));
    }
    first_changed_ = 0;
    std::fill(changed_.begin(), changed_.end(), kAllChannels);
}

// Of a hollow vertex only what was evaluated at it is worth something.
bool ShadingCache::tells(VertexId id, int channel) const {
    return !hollow(id, shading(channel)) || (!vertex(id).buried && evaluated(id, channel));
}

// The weighted mean of those parents that tell something; nothing if none does. A buried one tells
// what its own parents do, who are farther off, and counts only where no other does.
std::optional<Rgb> ShadingCache::predicted(VertexId id, int channel) const {
    struct Sum {
        Rgb value = Rgb(0);
        int weight = 0;
    } lit, buried;
    const Parents parents = this->parents(id);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (!tells(parents[i], channel)) continue;
        Sum& sum = vertex(parents[i]).buried ? buried : lit;
        const int w = parents.whole_weight(i);
        sum.value += static_cast<float>(w) * unpack_rgb9e5(shown_[channel].of(parents[i]));
        sum.weight += w;
    }
    const Sum& sum = lit.weight > 0 ? lit : buried;
    if (sum.weight == 0) return std::nullopt;
    return sum.value * (shown_unit_ / static_cast<float>(sum.weight));
}

// Takes the channel's value from where it now comes.
void ShadingCache::resolve_vertex(VertexId id, int channel) {
    const Estimate* e = vertex(id).buried ? nullptr : estimate(id, channel);
    const Rgb value = e ? e->mean : predicted(id, channel).value_or(Rgb(0));
    show(id, channel, value);
}

// The display's format reaches over 40 powers of two, lamps and starlight over more: its unit
// follows the brightest value, with room for a few brighter ones.
void ShadingCache::show(VertexId id, int channel, Rgb value) {
    constexpr float kMostUnits = 65408, kRoom = 0x1p-8f;
    if (max_component(value) > kMostUnits * shown_unit_) {
        const float unit =
            std::exp2(std::ceil(std::log2(max_component(value) / (kMostUnits * kRoom))));
        for (ShownValues& shown : shown_)
            for (std::uint32_t& bits : shown.values())
                bits = pack_rgb9e5(unpack_rgb9e5(bits) * (shown_unit_ / unit));
        shown_unit_ = unit;
    }
    const std::uint32_t bits = pack_rgb9e5(value / shown_unit_);
    if (bits == shown_[channel].of(id)) return;
    shown_[channel].set(id, bits);
    note_change(id, channel);
}

void ShadingCache::note_change(VertexId id, int channel) {
    changed_[index_of(id)] |= static_cast<std::uint8_t>(1u << channel);
    first_changed_ = std::min(first_changed_, index_of(id));
}

void ShadingCache::resolve_hollow(VertexId id, Shading shading) {
    const ChannelRange range = channels_of(shading);
    bool knows = !vertex(id).buried;
    for (int c = range.first; c < range.end; ++c) knows &= evaluated(id, c);
    for (const VertexId parent : parents(id)) knows |= !hollow(parent, shading);
    if (hollow(id, shading) != knows) return;
    Notes& notes = notes_[index_of(id)];
    (shading == Shading::glossy ? notes.hollow_in_gloss : notes.hollow) = knows ? 0 : 1;
    // What it is left out of, or comes into, is all that its children show.
    for (int c = range.first; c < range.end; ++c) note_change(id, c);
}

void ShadingCache::resolve_hollow(VertexId id) {
    resolve_hollow(id, Shading::irradiance);
    if (has_glossy()) resolve_hollow(id, Shading::glossy);
}

void ShadingCache::resolve_vertex(VertexId id) {
    resolve_hollow(id);
    for (int c = 0; c < channels(); ++c) resolve_vertex(id, c);
}

void ShadingCache::resolve() {
    // Parents come earlier in the array than their children, so one pass is enough.
    for (std::size_t i = first_changed_; i < vertices_.size(); ++i) {
        const auto id = static_cast<VertexId>(i);
        std::uint8_t news = 0;
        for (const VertexId parent : parents(id)) news |= changed_[index_of(parent)];
        if (news == 0) continue;
        resolve_hollow(id);
        for (int c = 0; c < channels(); ++c)
            if (news >> c & 1 && (vertices_[i].buried || !evaluated(id, c))) resolve_vertex(id, c);
    }
}

bool ShadingCache::resolve(VertexId id, int channel) {
    const bool was_hollow = hollow(id, shading(channel));
    const std::uint32_t shown_before = shown_[channel].of(id);
    resolve_hollow(id);
    resolve_vertex(id, channel);
    return was_hollow != hollow(id, shading(channel)) || shown_before != shown_[channel].of(id);
}

void ShadingCache::forget_changes() {
    if (first_changed_ < changed_.size())
        std::fill(changed_.begin() + static_cast<std::ptrdiff_t>(first_changed_), changed_.end(),
                  std::uint8_t{0});
    first_changed_ = kNothing;
}

}  // namespace chiaro
