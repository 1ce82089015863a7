// What rays through one row of pixels see, before it is put on patches.
#pragma once

#include "image_generator/outlines.h"
#include "image_generator/ray_view.h"

#include <vector>

namespace chiaro {

/// A piece of one side of one primitive in one pixel, straight in view or in a mirror.
struct SeenPiece {
    std::uint32_t x = 0;  // pixel in the row
    SurfacePoint point;   // mean place of the rays that met it
    bool front = true;
    Rgb reflectance = Rgb(0);  // as Fragment has them
    Rgb gloss = Rgb(0);
    Rgb glint = Rgb(0);  // as Glint has them; black: it is none
    Vec3 seen_from = Vec3(0);
    Trail trail = 0;      // by which the surface is seen
    Rgb weight = Rgb(0);  // as Sighting::weight
    float cosine = 1;     // as Sighting::cosine
};

struct SeenRow {
    std::vector<SeenPiece> pieces;  // in order of x
    std::vector<Rgb> background;    // a pixel: radiance that needs no shading
    // Of pixels that show something by chance: the background less that, and how many rays saw it.
    std::vector<Rgb> steady;
    std::vector<std::uint32_t> rays;
    std::vector<char> looked;  // by x, where not all of the row was looked at: whether it was here

    bool has(std::uint32_t x) const { return looked.empty() || looked[x]; }
    void start(std::size_t width) {
        background.assign(width, Rgb(0));
        steady.assign(width, Rgb(0));
        rays.assign(width, 0);
    }
    void add(std::uint32_t x, const Sighting& s) {
        background[x] += s.light;
        if (!by_chance(s.trail)) steady[x] += s.light;
    }
};

/// A view that rays look at.
struct Viewing {
    const RayCaster& rays;
    const View& view;
    Aov aov;
    ChainSettings chains;
    float footprint;  // size of a pixel in the picture's middle [radians]
};
Viewing make_viewing(const RayCaster& rays, const View& view, const RayViewSettings& settings);

/// What else is to be noted of a row, where it is not null: what the pixels' centres met, and the
/// rays' ways, which are appended.
struct RowNotes {
    CentreRow* centres = nullptr;
    std::vector<SightLine>* lines = nullptr;
};

/// One ray through the centre of each pixel of row `y`.
SeenRow see_row(const Viewing& viewing, int y, const RowNotes& notes);

/// Likewise of the pixels that `wanted` marks, by x; the others are not SeenRow::looked at.
SeenRow see_part_of_row(const Viewing& viewing, int y, std::vector<char> wanted,
                        std::vector<SightLine>& lines);

/// For each pixel of row `y`, whether something other than what its centre's ray met straight shows
/// in it: what is thinner than a pixel. Looks at four places in pixels that are not `known` to need
/// more rays.
std::vector<char> more_within(const Viewing& viewing, int y, const CentreRow& centres,
                              std::span<const char> known);

/// A pixel that takes side x side rays.
struct FinePixel {
    int x;
    int side;
};
/// What these rays through `pixels` of row `y`, in order of x, see: appends their pieces to `row`
/// and sets their backgrounds there.
void see_pixels(const Viewing& viewing, int y, std::span<const FinePixel> pixels, SeenRow& row);

/// What a pass of look_again() shows by chance: `row` has an entry for each of `pixels` in place of
/// those of a row.
void see_by_chance(const Viewing& viewing, std::span<const ChancePixel> pixels, std::uint32_t pass,
                   SeenRow& row);

/// Mean radiance over pixel (x, y) of the environment, which fills it, by as many looks as its map
/// has pixels there, up to 64.
Rgb mean_environment(const Viewing& viewing, int x, int y);

/// How a place on a primitive, (u, v) of SurfacePoint, changes from a pixel to its neighbours.
struct PixelFootprint {
    Vec2 across;
    Vec2 down;
};
/// The footprint of pixel (x, y), whose centre shows `point` straight, as if the primitive's plane
/// went on; nothing where it is seen at so low an angle that the plane ends before the next pixel
/// does, or where the primitive is less than a hundredth of the pixel.
std::optional<PixelFootprint> footprint_on_plane(const Scene& scene, const View& view, int x, int y,
                                                 const SurfacePoint& point);

/// Mean diffuse albedo over a pixel whose surface goes on as the primitive that its centre shows.
Rgb mean_diffuse_albedo(const Scene& scene, const SeenPiece& here, const PixelFootprint& footprint);

}  // namespace chiaro
