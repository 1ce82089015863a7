// What rays from the eye show: the surfaces on their way, and those seen in mirrors, glass and
// polish, so that all that a picture has of these is a look-up where such a chain ends.
#pragma once

#include "image_generator/sight_line.h"
#include "rays/ray_caster.h"
#include "scene/scattering.h"

#include <span>
#include <vector>

namespace chiaro {

/// A ray of the camera's.
struct Looking {
    Ray ray;                  // direction of unit length
    std::uint32_t x = 0;      // pixel in the row
    float part = 1;           // of the pixel
    std::uint32_t key = 0;    // names the pixel's random numbers
    std::uint32_t index = 0;  // of the ray among those of its pixel: they share a sequence
};

/// How a chain went on at a surface.
enum class Step : std::uint32_t { reflected = 1, transmitted = 2, scattered = 3 };

/// The steps from the eye to a surface, two bits each, the last one lowest; 0 if it is seen
/// straight, through nothing but blended layers. Neighbouring rays of one trail show one picture.
using Trail = std::uint32_t;
inline Trail longer(Trail trail, Step step) {
    return trail << 2 | static_cast<std::uint32_t>(step);
}
/// True if chance led there: a facet of a rough surface.
inline bool by_chance(Trail trail) {
    for (; trail != 0; trail >>= 2)
        if ((trail & 3) == static_cast<std::uint32_t>(Step::scattered)) return true;
    return false;
}

/// A surface that shows in a pixel, or the environment beyond all surfaces.
struct Sighting {
    std::uint32_t looking = 0;  // which ray shows it
    Trail trail = 0;
    Rgb weight = Rgb(0);  // radiance in the pixel over radiance that leaves the surface
    Rgb light = Rgb(0);   // what it emits, as the pixel shows it [cd/m2 a channel]
    Hit hit;              // none: the environment
    Vec3 position = Vec3(0);
    float distance = 0;    // from the eye, along the chain
    float cosine = 1;      // of its shading normal to where it is seen from
    Rgb diffuse = Rgb(0);  // diffuse_albedo() toward there
    float index2 = 1;      // squared index of the glass that it is seen within
    // What is seen in its rough facets: the cache's, or else found by chance, and how much of white
    // surroundings that would be (luminance). Lights are left out of it: glints show these.
    bool cached_gloss = false;
    float by_chance = 0;
    bool after_chance =
        false;  // seen in such facets, straight or through panes: its light is theirs
    Vec3 seen_from = Vec3(0);  // a place on the ray that met it
};

struct ChainSettings {
    bool chains = true;  // false: surfaces seen straight alone, not what they look like or emit
    int directions = 1;  // by chance, where a chain first meets polish that is not perfect
    float cached_facets = kInfinity;  // as RayViewSettings has it
    bool environment = true;          // it shines, so that rays beyond all surfaces look it up
};

/// Everything that the rays show; replaces `found`, the surfaces seen straight first and ray by
/// ray, front to back.
///
/// Of what is smooth every branch is followed, exactly. Diffuse light of the surfaces on a chain is
/// for the caller to add. Facets that are not smooth are looked at in `directions` random
/// directions, and in one a ray where chance has led the chain already; random, but the same on
/// every run. Chains end where less than 1/1024 of their ray is left, and after 16 surfaces.
///
/// Past the first surface rays are RayKind::transport: single-sided faces have backs in mirrors and
/// inside of solids. What a camera ray shows through a pane is still the camera's.
///
/// Appends to `lines`, unless it is null, the ways of all rays: what does not meet them changes
/// nothing that they show.
void look(const RayCaster& rays, std::span<const Looking> looking, const ChainSettings& settings,
          std::vector<Sighting>& found, std::vector<SightLine>* lines = nullptr);

}  // namespace chiaro
