// Textures averaged over a pixel.

#include "image_generator/view_fragments.h"

#include <algorithm>
#include <array>

namespace chiaro {

Rgb mean_diffuse_albedo(const Scene& scene, const SeenPiece& piece, const SurfacePoint& beside,
                        const SurfacePoint& below) {
    const SurfacePoint& here = piece.point;
    const Vec2 across(beside.u - here.u, beside.v - here.v);
    const Vec2 down(below.u - here.u, below.v - here.v);
    const auto albedo_at = [&](float x, float y) {
        SurfacePoint p = here;
        const Vec2 uv = Vec2(here.u, here.v) + x * across + y * down;
        p.u = std::clamp(uv.x, 0.0f, 1.0f);
        p.v = std::clamp(uv.y, 0.0f, 1.0f);
        return diffuse_albedo(bsdf_at(scene, p, piece.front), piece.cosine);
    };
    // Four places, irregular so that no pattern falls in step with them, show whether there is any
    // detail within the pixel; if so, sixteen resolve it.
    constexpr std::array<Vec2, 4> kProbes = {Vec2(-0.37f, -0.21f), Vec2(0.29f, -0.38f),
                                             Vec2(0.41f, 0.33f), Vec2(-0.18f, 0.27f)};
    Rgb sum(0), low(kInfinity), high(0);
    for (const Vec2 probe : kProbes) {
        const Rgb c = albedo_at(probe.x, probe.y);
        sum += c;
        low = glm::min(low, c);
        high = glm::max(high, c);
    }
    if (max_component(high - low) <= 0.02f * max_component(high)) return 0.25f * sum;
    sum = Rgb(0);
    for (int i = 0; i < 16; ++i)
        sum += albedo_at((static_cast<float>(i % 4) - 1.5f) / 4,
                         (static_cast<float>(i / 4) - 1.5f) / 4);
    return sum / 16.0f;
}

}  // namespace chiaro
