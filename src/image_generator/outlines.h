// Where in a view one ray a pixel is not enough: at outlines, of what is seen straight and of what
// is seen in mirrors and glass, at lamps, and in polish that is looked at by chance.
#pragma once

#include "image_generator/specular_chains.h"

namespace chiaro {

/// What the ray through a pixel's centre met, straight or at the end of a chain.
struct CentreHit {
    std::uint32_t x = 0;
    Trail trail = 0;
    float weight = 1;  // luminance of Sighting::weight: how much of the pixel it is
    MaterialId material = MaterialId::none;
    Vec3 normal = Vec3(0);
    Vec3 position = Vec3(0);
    float distance = 0;
    SurfacePoint point;
    bool textured = false;
    bool emissive = false;
    bool intricate =
        false;  // seen through, of textured emission, showing by chance what is seen in
                // it, or a map that is seen in something: rays alone tell what it fills
};

/// True if one flat face shows at both.
inline bool same_face(const CentreHit& a, const Hit& b) {
    return a.point.object == b.point.object && a.point.primitive == b.point.primitive &&
           a.normal == b.normal;
}

/// A row of pixels: what each centre's ray met first by each trail, in order of x; nothing of a
/// pixel that shows the environment alone.
struct CentreRow {
    std::vector<CentreHit> hits;
    std::vector<std::uint32_t> first;  // by x, and one more: the end

    std::span<const CentreHit> at(int x) const {
        return std::span(hits).subspan(first[x], first[x + 1] - first[x]);
    }
    int width() const { return static_cast<int>(first.size()) - 1; }
};

/// From what `looking`, one ray through each pixel's centre in order of x, was found to show.
CentreRow make_centre_row(const Scene& scene, std::span<const Looking> looking,
                          std::span<const Sighting> sightings);

/// Only what a ray that is in pixel `x` meets straight; none if it met nothing.
CentreHit centre_hit(const Scene& scene, const Ray& ray, const Hit& hit, std::uint32_t x);

/// The hit by `trail`; null if there is none.
const CentreHit* find_trail(std::span<const CentreHit> hits, Trail trail);

/// Whether an outline runs between two hits of one trail, `footprint` being a pixel's size in
/// radians.
bool outline_between(const CentreHit& a, const CentreHit& b, float footprint);

/// Pixels in which one ray is not enough: an outline runs toward one of the neighbours.
bool needs_more_rays(std::span<const CentreRow> centres, int x, int y, float footprint);

/// Whether the pixel or one beside it shows something that emits.
bool touches_light(std::span<const CentreRow> centres, int x, int y);

/// The hits of two neighbours, beside and above or below, that have the trail of `here`, a hit of
/// pixel (x, y), and lie on the same primitive; null where there is none.
struct Neighbours {
    const CentreHit* beside = nullptr;
    const CentreHit* below = nullptr;
};
Neighbours on_same_primitive(std::span<const CentreRow> centres, const CentreHit& here, int y);

}  // namespace chiaro
