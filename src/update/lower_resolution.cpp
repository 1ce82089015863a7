#include "update/lower_resolution.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace chiaro {
namespace {

// Pixels that a vertex speaks for in a channel before finer ones are evaluated: those of the
// largest patch, in the channel's front or above, whose corner it is; on the mesh, of all that is
// predicted from it.
std::vector<float> pixels_spoken_for(const ShadingCache& cache, int channel) {
    std::vector<float> pixels(cache.vertices().size(), 0.0f);
    for (const Patch& p : cache.patches()) {
        if (!p.is_root() && !cache.patch(static_cast<PatchId>(p.parent)).refined(channel)) continue;
        for (int c = 0; c < p.corner_count(); ++c) {
            float& known = pixels[index_of(p.corners[c])];
            known = std::max(known, cache.pixels(p, channel));
        }
    }
    for (std::size_t i = pixels.size(); i-- > 0;) {  // parents come before children
        const auto id = static_cast<VertexId>(i);
        if (!cache.vertex(id).of_mesh) continue;
        const Parents parents = cache.parents(id);
        for (std::size_t k = 0; k < parents.size(); ++k)
            pixels[index_of(parents[k])] += parents.weight(k) * pixels[i];
    }
    return pixels;
}

std::vector<char> stale_on(const ShadingCache& cache, int channel, std::span<const char> objects) {
    std::vector<char> stale(cache.vertices().size(), 0);
    for (std::size_t i = 0; i < stale.size(); ++i) {
        const auto id = static_cast<VertexId>(i);
        const Estimate* e = cache.estimate(id, channel);
        stale[i] = e && e->stale && objects[index_of(cache.surface_point(id).object)] ? 1 : 0;
    }
    return stale;
}

// No longer refines patches for stale vertices alone none of whose children is refined, or larger
// on the screen than `least`.
void lower_front(ShadingCache& cache, int channel, float least, const std::vector<char>& stale) {
    for (std::size_t i = cache.patches().size(); i-- > 0;) {  // children come behind their parents
        Patch& p = cache.patch(static_cast<PatchId>(i));
        if (!p.refined(channel)) continue;
        bool keep = false, any = false;
        for (int k = 0; k < child_count(p.split); ++k) {
            const Patch& child = cache.patch(offset_by(p.first_child, k));
            keep |= child.refined(channel) || cache.pixels(child, channel) > least;
            for (int c = 0; c < child.corner_count(); ++c)
                any |= stale[index_of(child.corners[c])] != 0;
        }
        if (any && !keep) p.refined_channels &= static_cast<std::uint8_t>(~(1u << channel));
    }
}

}  // namespace

std::size_t lower_resolution(ShadingCache& cache, int channel, std::span<const char> changing,
                             std::size_t most, Rest rest) {
    if (std::ranges::count(changing, 0) == std::ssize(changing)) return 0;
    const std::vector<char> stale = stale_on(cache, channel, changing);
    std::vector<float> pixels = pixels_spoken_for(cache, channel);
    std::vector<float> of_stale;
    for (std::size_t i = 0; i < pixels.size(); ++i)
        if (pixels[i] > 0 && stale[i]) of_stale.push_back(pixels[i]);
    float least = 0;
    if (of_stale.size() > most) {
        const auto last = of_stale.begin() + static_cast<std::ptrdiff_t>(most);
        std::nth_element(of_stale.begin(), last, of_stale.end(), std::greater<>());
        least = *last;
        lower_front(cache, channel, least, stale);
    }
    // What is drawn still, of those that cannot be paid.
    std::vector<char> shown(pixels.size(), 0);
    if (rest == Rest::waits && least > 0) {
        const std::vector<float> drawn = pixels_spoken_for(cache, channel);
        for (std::size_t i = 0; i < shown.size(); ++i)
            shown[i] = drawn[i] > 0 && pixels[i] <= least ? 1 : 0;
    }

    std::size_t count = 0;
    for (std::size_t i = 0; i < stale.size(); ++i) {
        if (!stale[i] || shown[i]) continue;
        cache.forget(static_cast<VertexId>(i), static_cast<std::uint8_t>(1u << channel));
        ++count;
    }
    return count;
}

}  // namespace chiaro
