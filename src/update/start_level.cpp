#include "update/start_level.h"

#include "sample_selector/gain.h"

#include <queue>

namespace chiaro {
namespace {

// Patches that cover fewer pixels wait for a reason to be divided.
constexpr std::uint32_t kSmallest = 16;

// A patch of no more fragments than this is seen wherever its corners are.
constexpr std::uint32_t kSeenAllOver = 64;

struct Large {
    float pixels;
    PatchId patch;
    // Ties go to the older patch, so that the order is the same everywhere.
    bool operator<(const Large& o) const {
        return pixels != o.pixels ? pixels < o.pixels : patch > o.patch;
    }
};

}  // namespace

void even_out(ShadingCache& cache, IdMap& map, int channel, std::size_t vertex_budget, Cycle now) {
    std::priority_queue<Large> large;
    std::size_t in_view = 0;
    const auto add = [&](PatchId id) {
        const Patch& p = cache.patch(id);
        const float pixels = cache.pixels(p, channel);
        if (!(pixels > 0) || !on_front(cache, id, channel)) return;
        ++in_view;  // a regular mesh has about as many vertices as leaves
        if (pixels > kSmallest && p.fragment_count > 1 && p.divisible()) large.push({pixels, id});
    };
    for (std::size_t i = 0; i < cache.patches().size(); ++i) add(static_cast<PatchId>(i));

    while (!large.empty() && in_view < vertex_budget) {
        const PatchId id = large.top().patch;
        large.pop();
        if (cache.patch(id).is_leaf()) subdivide_seen(cache, map, id, now);
        cache.patch(id).refined_channels |= static_cast<std::uint8_t>(1u << channel);
        --in_view;
        for (int c = 0; c < child_count(cache.patch(id).split); ++c)
            add(offset_by(cache.patch(id).first_child, c));
    }
}

std::size_t missing_in_view(const ShadingCache& cache, int channel) {
    std::vector<char> counted(cache.vertices().size(), 0);
    std::size_t missing = 0;
    for (std::size_t i = 0; i < cache.patches().size(); ++i) {
        const Patch& p = cache.patches()[i];
        if (!(cache.pixels(p, channel) > 0) || !on_front(cache, static_cast<PatchId>(i), channel))
            continue;
        for (int c = 0; c < p.corner_count(); ++c) {
            char& known = counted[index_of(p.corners[c])];
            if (known || cache.evaluated(p.corners[c], channel)) continue;
            known = 1;
            ++missing;
        }
    }
    return missing;
}

void evaluate_in_view(const ShadingCache& cache, std::span<const std::uint32_t> samples,
                      ShadeWork& work) {
    for (std::size_t i = 0; i < cache.patches().size(); ++i) {
        const Patch& p = cache.patches()[i];
        if (p.fragment_count == 0) continue;
        for (int channel = 0; channel < cache.channels(); ++channel) {
            if (!(cache.pixels(p, channel) > 0)) continue;
            if (!on_front(cache, static_cast<PatchId>(i), channel)) continue;
            for (int c = 0; c < p.corner_count(); ++c)
                work.evaluate(cache, p.corners[c], channel, samples[channel]);
        }
    }
}

namespace {

bool all_dark(const ShadingCache& cache, const Patch& p) {
    for (int c = 0; c < p.corner_count(); ++c)
        if (!cache.dark(p.corners[c])) return false;
    return true;
}

}  // namespace

std::vector<PatchId> dug_in(const ShadingCache& cache, int channel) {
    std::vector<PatchId> found;
    for (std::size_t i = 0; i < cache.patches().size(); ++i) {
        const Patch& p = cache.patches()[i];
        if (!p.divisible() || !(cache.pixels(p, channel) > 0) ||
            cache.buried_corners(p) + 1 < p.corner_count())
            continue;
        // A patch whose corners found some light is exposed when it is small; one that would be
        // black is divided to the last.
        if (p.fragment_count <= (all_dark(cache, p) ? 1 : kSmallest)) continue;
        if (on_front(cache, static_cast<PatchId>(i), channel))
            found.push_back(static_cast<PatchId>(i));
    }
    return found;
}

void expose_if_seen(ShadingCache& cache, PatchId id) {
    const Patch& p = cache.patch(id);
    if (p.fragment_count == 0 || p.fragment_count > kSeenAllOver) return;
    if (cache.buried_corners(p) < p.corner_count()) return;
    if (p.fragment_count > 1 && all_dark(cache, p)) return;
    for (int c = 0; c < p.corner_count(); ++c) cache.expose(p.corners[c]);
}

}  // namespace chiaro
