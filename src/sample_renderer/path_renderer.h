// The renderer `path`: next event estimation, multiple importance sampling, Russian roulette, no
// cap on bounces. The ground truth that other renderers are measured against.
#pragma once

#include "sample_renderer/next_event.h"
#include "sample_renderer/sample_renderer.h"
#include "scene/open_sides.h"

namespace chiaro {

/// Surfaces are Lambertian of their base colour on both sides. Irradiance is taken with the cosine
/// about the shading normal, folded up where it reaches below the real plane (next_event.h).
///
/// Thread: as SampleRenderer. Keeps references: objects and materials may be edited between calls,
/// if the caster and the area lights are brought up to date with them; build anew when punctual
/// lights change. Where `open_sides` is null, nothing is buried. Of Light::total, `first_sample`
/// counts direct samples, and the indirect ones before it are taken to have been in the same
/// proportion.
class PathRenderer : public SampleRenderer {
public:
    PathRenderer(const Scene& scene, const RayCaster& caster, const AreaLights& area_lights,
                 const OpenSides* open_sides, int threads);
    void shade(std::span<const ShadeRequest> requests, std::span<ShadeResult> results) override;
    SampleCosts typical_costs() const override;

private:
    LitScene lit_;
    const OpenSides* open_sides_;
    int threads_;
};

/// A place in space that light is measured at, as by a lux meter: it need not lie on a surface.
struct MeterPlace {
    Vec3 position;
    Vec3 normal;  // unit
};

/// As PathRenderer::shade(), at `places` instead of the requests' surface points, which are not
/// read. All three spans are of one length. The same bits on any number of threads.
void shade_places(const LitScene& lit, std::span<const MeterPlace> places,
                  std::span<const ShadeRequest> requests, int threads,
                  std::span<ShadeResult> results);

}  // namespace chiaro
