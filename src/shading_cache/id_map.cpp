#include "shading_cache/id_map.h"

#include "base/parallel.h"
#include "shading_cache/interpolate.h"

#include <algorithm>
#include <array>

namespace chiaro {
namespace {

// Weighs a patch whose fragments are in place: squares of what it is in each pixel.
void weigh(const IdMap& map, Patch& patch) {
    const float alone =
        map.irradiance ? 1.0f : std::max<float>(patch.reflectance, 1) / 255.0f / kPi;
    float pixels = 0, glossy_pixels = 0;
    const auto range = fragments_of(map, patch);
    for (std::size_t i = 0; i < range.size();) {
        const std::uint32_t pixel = map.fragments[range[i]].pixel;
        float share = 0, gloss = 0;
        for (; i < range.size() && map.fragments[range[i]].pixel == pixel; ++i) {
            share += luminance(map.fragments[range[i]].reflectance);
            gloss += luminance(map.fragments[range[i]].gloss);
        }
        pixels += share * share;
        glossy_pixels += gloss * gloss;
    }
    patch.pixels = pixels / (alone * alone);
    patch.glossy_pixels = glossy_pixels;
}

// Sorts an inner patch's range of fragments by child, stably, and moves each into its child's
// coordinates.
void hand_down(ShadingCache& cache, IdMap& map, PatchId parent, Cycle now) {
    const Patch& p = cache.patch(parent);
    const auto range = fragments_of(map, p);
    const int children = child_count(p.split);

    std::array<std::vector<std::uint32_t>, 4> sorted;
    for (const std::uint32_t f : range) {
        Fragment& fragment = map.fragments[f];
        const int child = child_at(p.split, fragment.local);
        fragment.local = to_child(p.split, child, fragment.local);
        fragment.patch = offset_by(p.first_child, child);
        sorted[child].push_back(f);
    }

    std::uint32_t next = p.first_fragment;
    for (int c = 0; c < children; ++c) {
        Patch& child = cache.patch(offset_by(p.first_child, c));
        child.first_fragment = next;
        child.fragment_count = static_cast<std::uint32_t>(sorted[c].size());
        if (child.fragment_count > 0) child.last_seen = now;
        std::copy(sorted[c].begin(), sorted[c].end(), map.order.begin() + next);
        weigh(map, child);
        next += child.fragment_count;
    }
}

// Hands a root's fragments down to the leaves. Touches nothing of other roots.
void hand_to_leaves(ShadingCache& cache, IdMap& map, PatchId root, Cycle now) {
    weigh(map, cache.patch(root));
    std::vector<PatchId> open = {root};
    while (!open.empty()) {
        const PatchId id = open.back();
        open.pop_back();
        if (cache.patch(id).is_leaf() || cache.patch(id).fragment_count == 0) continue;
        hand_down(cache, map, id, now);
        for (int c = 0; c < child_count(cache.patch(id).split); ++c)
            open.push_back(offset_by(cache.patch(id).first_child, c));
    }
}

}  // namespace

void attach(ShadingCache& cache, IdMap& map, Cycle now, int threads) {
    for (Patch& patch : cache.patches()) {
        if (patch.fragment_count > 0) patch.last_seen = now;  // in view until now
        patch.fragment_count = 0;
        patch.pixels = patch.glossy_pixels = 0;
    }

    // Fragments by root: count, place, fill.
    for (const Fragment& f : map.fragments) ++cache.patch(f.patch).fragment_count;
    std::uint32_t next = 0;
    std::vector<PatchId> roots;
    for (std::size_t i = 0; i < cache.patches().size(); ++i) {
        Patch& patch = cache.patches()[i];
        if (patch.fragment_count == 0) continue;
        roots.push_back(static_cast<PatchId>(i));
        patch.first_fragment = next;
        patch.last_seen = now;
        next += patch.fragment_count;
        patch.fragment_count = 0;
    }
    map.order.resize(map.fragments.size());
    for (std::uint32_t f = 0; f < map.fragments.size(); ++f) {
        Patch& patch = cache.patch(map.fragments[f].patch);
        map.order[patch.first_fragment + patch.fragment_count++] = f;
    }

    parallel_for(threads, roots.size(),
                 [&](std::size_t i) { hand_to_leaves(cache, map, roots[i], now); });
}

PatchId subdivide_seen(ShadingCache& cache, IdMap& map, PatchId leaf, Cycle now) {
    const PatchId first = cache.subdivide(leaf);
    hand_down(cache, map, leaf, now);
    return first;
}

void hand_to_leaf(const ShadingCache& cache, Fragment& fragment) {
    while (!cache.patch(fragment.patch).is_leaf()) {
        const Patch& p = cache.patch(fragment.patch);
        const int child = child_at(p.split, fragment.local);
        fragment.local = to_child(p.split, child, fragment.local);
        fragment.patch = offset_by(p.first_child, child);
    }
}

Rgb shown_by(const ShadingCache& cache, const Fragment& f, const FadeIn* fade) {
    Rgb sum(0);
    if (f.reflectance != Rgb(0))
        sum += f.reflectance * irradiance_at(cache, f.patch, f.local, fade);
    if (f.gloss != Rgb(0)) sum += f.gloss * glossy_at(cache, f.patch, f.local, fade);
    return sum;
}

std::span<const std::uint32_t> fragments_of(const IdMap& map, const Patch& patch) {
    return std::span(map.order).subspan(patch.first_fragment, patch.fragment_count);
}

}  // namespace chiaro
