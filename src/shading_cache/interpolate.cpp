#include "shading_cache/interpolate.h"

#include <algorithm>

namespace chiaro {
namespace {

struct Blend {
    Rgb sum = Rgb(0);
    float weight = 0;

    void add(const Shown& value, float w) {
        sum += w * value.weight * value.value;
        weight += w * value.weight;
    }
    Shown result() const { return weight > 0 ? Shown{sum / weight, 1} : Shown{Rgb(0), 0}; }
};

}  // namespace

FanPlace fan_place(bool quad, Vec2 p) {
    if (!quad) {
        const std::array<float, 3> w = {1 - p.x - p.y, p.x, p.y};
        const auto smallest = std::min_element(w.begin(), w.end()) - w.begin();
        const int edge = static_cast<int>((smallest + 1) % 3);
        const float low = std::max(w[smallest], 0.0f);
        return {edge, 3 * low, w[edge] - low, w[(edge + 1) % 3] - low};
    }
    // Along each edge: the distance from it, and the way gone along it.
    const std::array<Vec2, 4> by_edge = {Vec2(p.y, p.x), Vec2(1 - p.x, p.y), Vec2(1 - p.y, 1 - p.x),
                                         Vec2(p.x, 1 - p.y)};
    int edge = 0;
    for (int e = 1; e < 4; ++e)
        if (by_edge[e].x < by_edge[edge].x) edge = e;
    const float away = std::max(by_edge[edge].x, 0.0f);
    const float along = by_edge[edge].y;
    return {edge, 2 * away, 1 - along - away, along - away};
}

namespace {

Rgb shown_at(const ShadingCache& cache, PatchId leaf, Vec2 local, Shading shading,
             const FadeIn* fade) {
    const auto shown = [&](VertexId v) {
        return fade ? fade->shown_total(v, shading) : cache.shown_total(v, shading);
    };
    const Patch& patch = cache.patch(leaf);
    const int n = patch.corner_count();
    FanPlace place = fan_place(n == 4, local);
    VertexId a = patch.corners[place.edge];
    VertexId b = patch.corners[(place.edge + 1) % n];

    // Neighbours may have halved this edge, more than once: find the part that holds the point.
    while (const auto middle = cache.midpoint(a, b)) {
        if (place.a >= place.b) {
            place = {place.edge, place.centre, place.a - place.b, 2 * place.b};
            b = *middle;
        } else {
            place = {place.edge, place.centre, 2 * place.a, place.b - place.a};
            a = *middle;
        }
    }

    Blend centre;
    for (int i = 0; i < n; ++i) centre.add(shown(patch.corners[i]), 1);
    Blend total;
    total.add(centre.result(), place.centre);
    total.add(shown(a), place.a);
    total.add(shown(b), place.b);
    // On an edge between hollow vertices the centre still knows something.
    return (total.weight > 0 ? total : centre).result().value;
}

}  // namespace

Rgb irradiance_at(const ShadingCache& cache, PatchId leaf, Vec2 local, const FadeIn* fade) {
    return shown_at(cache, leaf, local, Shading::irradiance, fade);
}

Rgb glossy_at(const ShadingCache& cache, PatchId leaf, Vec2 local, const FadeIn* fade) {
    return shown_at(cache, leaf, local, Shading::glossy, fade);
}

}  // namespace chiaro
