#include "shading_cache/fade_in.h"

#include "base/error.h"
#include "base/parallel.h"

#include <cmath>

namespace chiaro {
namespace {

constexpr std::size_t kAtOnce = 4096;  // vertices that one thread moves on

// Hollow vertices show nothing that a change could start from.
constexpr Rgb kNothing(-1);
bool shows_nothing(Rgb shown) {
    return shown.r < 0;
}

// What its parents show by now, who come before it; what the cache shows where it has none.
Rgb first_shown(const ShadingCache& cache, std::span<const Rgb> shown, VertexId id,
                Shading shading) {
    Rgb sum(0);
    float weight = 0;
    const Parents parents = cache.parents(id);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        if (shows_nothing(shown[index_of(parents[i])])) continue;
        sum += parents.weight(i) * shown[index_of(parents[i])];
        weight += parents.weight(i);
    }
    return weight > 0 ? sum / weight : cache.shown_total(id, shading).value;
}

}  // namespace

FadeIn::FadeIn(int frames) : part_(1 - std::pow(0.1f, 1 / static_cast<float>(frames))) {
    check(frames > 0, "FadeIn: no frames");
}

void FadeIn::advance(const ShadingCache& cache, int threads) {
    // All ids have changed.
    if (packs_ != cache.packs()) {
        irradiance_.clear();
        glossy_.clear();
        packs_ = cache.packs();
    }
    advance(cache, Shading::irradiance, threads);
    if (cache.has_glossy()) advance(cache, Shading::glossy, threads);
}

void FadeIn::advance(const ShadingCache& cache, Shading shading, int threads) {
    std::vector<Rgb>& shown = this->shown(shading);
    const bool all_are_new = shown.empty();
    const std::size_t known = shown.size(), count = cache.vertices().size();
    shown.resize(count);
    for (std::size_t i = known; i < count; ++i) {
        const auto id = static_cast<VertexId>(i);
        shown[i] = all_are_new ? cache.shown_total(id, shading).value
                               : first_shown(cache, shown, id, shading);
    }
    parallel_for_ranges(threads, count, kAtOnce, [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const Shown now = cache.shown_total(static_cast<VertexId>(i), shading);
            if (now.weight == 0)
                shown[i] = kNothing;
            else if (shows_nothing(shown[i]))
                shown[i] = now.value;
            else
                shown[i] += part_ * (now.value - shown[i]);
        }
    });
}

Shown FadeIn::shown_total(VertexId id, Shading shading) const {
    const std::vector<Rgb>& shown = shading == Shading::glossy ? glossy_ : irradiance_;
    check(index_of(id) < shown.size(), "FadeIn: the vertex is new");
    const Rgb value = shown[index_of(id)];
    return shows_nothing(value) ? Shown{Rgb(0), 0} : Shown{value, 1};
}

}  // namespace chiaro
