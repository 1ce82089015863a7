// The share of a Bsdf that transmits: panes and solids, smooth and rough. For bsdf.cpp.
#pragma once

#include "scene/bsdf.h"

namespace chiaro {

/// As eval_bsdf() and pdf_bsdf(), of glass alone; the first direction has z > 0, alpha is above 0.
Rgb eval_glass(const Bsdf& bsdf, Vec3 to_eye, Vec3 to_light);
float pdf_glass(const Bsdf& bsdf, Vec3 from, Vec3 to);

/// A direction with the density pdf_glass(); its z tells whether the light is transmitted. `weight`
/// counts where the glass is smooth: value x |cosine| / density. None: a facet that leads nowhere.
struct GlassDirection {
    Vec3 direction;
    Rgb weight;
};
std::optional<GlassDirection> sample_glass(const Bsdf& bsdf, Vec3 from, float u_lobe, Vec2 u,
                                           Transport transport);

/// Adds the share of the glass, which is smooth, to what split_smooth() gives.
void add_smooth_glass(const Bsdf& bsdf, Vec3 from, SmoothSplit& split);

/// As total_albedo(), of glass alone.
Rgb glass_total_albedo(const Bsdf& bsdf, float cosine);

/// Direction about +z with density cosine / pi; `u` in [0, 1)^2.
Vec3 cosine_direction(Vec2 u);

/// The same direction on the other side of the surface.
inline Vec3 across(Vec3 w) {
    return {w.x, w.y, -w.z};
}

}  // namespace chiaro
