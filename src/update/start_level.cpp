#include "update/start_level.h"

#include "sample_selector/gain.h"

#include <algorithm>
#include <queue>

namespace chiaro {
namespace {

// Patches that cover fewer pixels wait for a reason to be divided.
constexpr std::uint32_t kSmallest = 16;

// What nothing is known of is black: only specks of less than a pixel wait for their turn.
constexpr float kSpeck = 1;

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

StartLevel choose_start_level(const ShadingCache& cache, const MeshFront& mesh, int channel,
                              std::size_t fewest, std::size_t most) {
    std::vector<float> roots;
    double total = 0;
    for (const Patch& p : cache.patches()) {
        const float pixels = p.is_root() ? cache.pixels(p, channel) : 0;
        if (!(pixels > 0)) continue;
        roots.push_back(pixels);
        total += pixels;
    }
    const auto counts = mesh.count_by_level(cache.shading(channel));
    if (counts[0] <= most) return {0, fewest};

    for (int level = 1;; ++level) {
        const bool coarsest = level + 1 == MeshFront::kLevels || counts[level + 1] == 0;
        // What patches that are larger than a vertex's part of the view are to be divided into.
        const double part = total / std::max<double>(1, static_cast<double>(counts[level]));
        double divided = 0;
        for (const float pixels : roots)
            if (pixels > part) divided += pixels / part;
        const std::size_t vertices = counts[level] + static_cast<std::size_t>(divided);
        if (vertices <= most || coarsest) return {level, std::min(vertices, most)};
    }
}

void even_out(ShadingCache& cache, IdMap& map, const MeshFront& mesh, int channel,
              const StartLevel& start, Cycle now) {
    std::priority_queue<Large> large;
    std::size_t in_view = 0, roots_in_view = 0;
    const auto add = [&](PatchId id) {
        const Patch& p = cache.patch(id);
        const float pixels = cache.pixels(p, channel);
        if (!(pixels > 0) || !on_front(cache, id, channel)) return;
        ++in_view;  // a regular mesh has about as many vertices as leaves
        if (p.is_root()) ++roots_in_view;
        if (pixels > kSmallest && p.fragment_count > 1 && p.divisible()) large.push({pixels, id});
    };
    for (std::size_t i = 0; i < cache.patches().size(); ++i) add(static_cast<PatchId>(i));
    if (start.level > 0)
        in_view += mesh.count_by_level(cache.shading(channel))[start.level] - roots_in_view;

    while (!large.empty() && in_view < start.vertices) {
        const PatchId id = large.top().patch;
        large.pop();
        if (cache.patch(id).is_leaf()) subdivide_seen(cache, map, id, now);
        cache.patch(id).refined_channels |= static_cast<std::uint8_t>(1u << channel);
        --in_view;
        for (int c = 0; c < child_count(cache.patch(id).split); ++c)
            add(offset_by(cache.patch(id).first_child, c));
    }
}

std::vector<VertexId> missing_in_view(const ShadingCache& cache, const MeshFront& mesh, int channel,
                                      int start_level) {
    std::vector<char> passed(cache.vertices().size(), 0);
    std::vector<VertexId> missing;
    const auto want = [&](VertexId id) {
        if (passed[index_of(id)] || cache.evaluated(id, channel)) return;
        passed[index_of(id)] = 1;
        missing.push_back(id);
    };
    for (std::size_t place = 0; place < mesh.vertices().size(); ++place) {
        if (!mesh.in_view(place, cache.shading(channel))) continue;
        const VertexId id = mesh.vertices()[place];
        if (mesh.level(place) >= start_level || cache.parents(id).empty())
            want(id);
        else
            passed[index_of(id)] = 1;
    }
    for (std::size_t i = 0; i < cache.patches().size(); ++i) {
        const Patch& p = cache.patches()[i];
        if (!(cache.pixels(p, channel) > 0) || !on_front(cache, static_cast<PatchId>(i), channel))
            continue;
        for (int c = 0; c < p.corner_count(); ++c) {
            // Parts of a patch that was divided want all that they are drawn from.
            if (!p.is_root()) passed[index_of(p.corners[c])] = 0;
            want(p.corners[c]);
        }
    }
    std::sort(missing.begin(), missing.end());
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    return missing;
}

std::vector<VertexId> hollow_in_view(const ShadingCache& cache, const MeshFront& mesh,
                                     int channel) {
    std::vector<VertexId> hollow;
    for (std::size_t place = 0; place < mesh.vertices().size(); ++place) {
        const VertexId id = mesh.vertices()[place];
        if (!cache.hollow(id, cache.shading(channel)) || cache.evaluated(id, channel)) continue;
        const bool half_known = cache.evaluated(id) && !cache.vertex(id).buried;
        const float pixels = mesh.pixels(cache, place, channel);
        if (pixels >= kSpeck || (half_known && pixels > 0)) hollow.push_back(id);
    }
    return hollow;
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
