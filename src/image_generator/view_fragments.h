// What rays through one row of pixels see, before it is put on patches.
#pragma once

#include "image_generator/ray_view.h"

#include <vector>

namespace chiaro {

/// A piece of one side of one primitive in one pixel.
struct SeenPiece {
    std::uint32_t x = 0;  // pixel in the row
    SurfacePoint point;   // mean place of the rays that met it
    bool front = true;
    Rgb reflectance = Rgb(0);  // as Fragment::reflectance
};

/// What the ray through a pixel's centre met first, to find outlines by.
struct CentreHit {
    ObjectId object = ObjectId::none;
    MaterialId material = MaterialId::none;
    Vec3 normal = Vec3(0);
    Vec3 position = Vec3(0);
    float distance = 0;
    SurfacePoint point;
    bool textured = false;
    bool emissive = false;
    bool intricate = false;  // seen through, or of textured emission: rays alone tell what it fills
};

struct SeenRow {
    std::vector<SeenPiece> pieces;  // in order of x
    std::vector<Rgb> background;    // a pixel: radiance that needs no shading
};

/// One ray through the centre of each pixel of row `y`; `centres` gets one entry a pixel.
SeenRow see_row(const RayCaster& rays, const View& view, int y, Aov aov,
                std::vector<CentreHit>& centres);

/// For each pixel of row `y`, whether something other than what its centre's ray met shows in it:
/// what is thinner than a pixel. Looks at four places in pixels that are not `known` to need more
/// rays.
std::vector<char> more_within(const RayCaster& rays, const View& view, int y,
                              std::span<const CentreHit> centres, float footprint,
                              std::span<const char> known);

/// side x side rays through pixel (x, y), replacing what the centre's ray saw: appends to
/// `row.pieces` and sets row.background[x].
void see_pixel(const RayCaster& rays, const View& view, int x, int y, int side, Aov aov,
               SeenRow& row);

/// Mean radiance over pixel (x, y) of the environment, which fills it, by as many looks as its map
/// has pixels there, up to 64; `footprint` is a pixel's size in radians.
Rgb mean_environment(const Scene& scene, const View& view, int x, int y, float footprint);

/// Mean base colour over a pixel that shows one primitive alone, from the surface points that its
/// own centre and those of two neighbours show, to the side and below or above.
Rgb mean_base_color(const Scene& scene, const SurfacePoint& here, const SurfacePoint& beside,
                    const SurfacePoint& below);

/// Whether an outline runs between two pixels, `footprint` being a pixel's size in radians.
bool outline_between(const CentreHit& a, const CentreHit& b, float footprint);

}  // namespace chiaro
