// BOX Image Generator, by rays: the ID map and the picture, for headless use and for machines where
// rays draw faster than their OpenGL.
#pragma once

#include "base/image.h"
#include "rays/ray_caster.h"
#include "scene/camera.h"
#include "scene/open_sides.h"
#include "shading_cache/id_map.h"

#include <optional>

namespace chiaro {

/// What a picture's pixels hold.
enum class Aov {
    radiance,    // [cd/m2 a channel]
    irradiance,  // [lux a channel] on the surfaces in view, emission and reflectance left out
};

/// How finely outlines and textures are looked at.
enum class ViewQuality {
    one_ray,      // a ray through each pixel's centre: for a view that is moving
    antialiased,  // and 16 through each pixel with an outline, 64 at lamps; textures averaged
};

struct RayViewSettings {
    ViewQuality quality = ViewQuality::antialiased;
    Aov aov = Aov::radiance;
    int threads = 1;
    /// Facets of at least this width (Bsdf::alpha), seen straight or through panes, show the
    /// cache's glossy radiance; what narrower ones show is found by rays.
    float cached_facets = kInfinity;
    /// Whether the environment shines, if the caller knows: to find out, its map is read.
    std::optional<bool> environment = std::nullopt;
};

/// The fragments that `view` shows, each on the root patch that holds it (made if new); attach()
/// hands them down to the leaves. Single-sided faces are passed from behind; blended surfaces are
/// composited front to back, the nearest kMostLayers (rays/ray_caster.h) on a ray's way; those
/// behind them do not show. Mirrors and glass show what is seen in them, and polish shows it by
/// chance (specular_chains.h); what that shows of lights is left to whoever has light samples, as
/// the map's glints. A picture of irradiance shows surfaces alone. Marks in `open_sides` what was
/// seen straight, in mirrors and through glass, but not by chance, unless it is null.
IdMap make_id_map(ShadingCache& cache, const RayCaster& rays, const View& view,
                  const RayViewSettings& settings, OpenSides* open_sides);

/// What a further pass of rays through some pixels shows by chance.
struct ChancePass {
    std::vector<Fragment> fragments;  // on root patches; `pixel` is an index into the pixels asked
    std::vector<Rgb> light;           // by pixel: emission and environment
    std::vector<Glint> glints;        // `pixel` likewise
};

/// Looks again at pixels of a map of `view` by random directions of their own: all that polish
/// shows there, and none of what chance has no say in, by the first look's rays. Passes are
/// numbered from 1 and continue each pixel's sequence. Of what lies together in a pixel one place
/// stands for all, another in every pass.
ChancePass look_again(ShadingCache& cache, const RayCaster& rays, const View& view,
                      const RayViewSettings& settings, std::span<const ChancePixel> pixels,
                      std::uint32_t pass);

/// The picture of an attached map: what its fragments show, over the background; with `fade`, as
/// far as that has come.
Image draw(const ShadingCache& cache, const IdMap& map, int threads, const FadeIn* fade = nullptr);

}  // namespace chiaro
