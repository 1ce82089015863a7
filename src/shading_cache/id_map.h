// What of the view lies on which patch (4.1), kept for as long as the view rests.
#pragma once

#include "base/image.h"
#include "shading_cache/fade_in.h"

#include <vector>

namespace chiaro {

/// A piece of surface that shows in a pixel. A pixel inside a surface has one fragment, one on an
/// outline several, whose reflectances carry their parts of the pixel.
struct Fragment {
    std::uint32_t pixel;     // y * width + x
    PatchId patch;           // the leaf on which it lies
    Vec2 local;              // its place there (split.h)
    Rgb reflectance;         // radiance in the pixel over irradiance here: coverage x albedo / pi
    Rgb gloss = Rgb(0);      // and over glossy radiance here: coverage, where it is cached
    bool by_chance = false;  // polish shows it there, by random directions
};

/// A surface whose polish, too even to be cached, shows lights in a pixel.
struct Glint {
    std::uint32_t pixel;
    SurfacePoint where;
    bool front;
    Vec3 seen_from;      // a place on the ray that shows it, world space
    Rgb weight;          // radiance in the pixel over radiance toward there
    Rgb light = Rgb(0);  // radiance toward there of lights [cd/m2 a channel], once
    bool lit = false;    // that was sampled
};

/// A pixel in which polish shows something, which the first look at it found by chance. Of the
/// map's fragments and background there the steady part is what chance had no say in.
struct ChancePixel {
    std::uint32_t pixel;
    std::uint32_t rays;  // that looked at it
    Rgb steady_background;
};

/// The paper's map of patch identifiers, by rays instead of a rendered image: kept with the list of
/// fragments of each patch, so that a still view needs no new map a cycle. Inner patches know their
/// fragments too: those of their descendants, consecutive in `order`.
struct IdMap {
    int width = 0;
    int height = 0;
    std::vector<Fragment> fragments;            // in order of pixels
    std::vector<std::uint32_t> first_of_pixel;  // width x height + 1 entries
    std::vector<std::uint32_t> order;           // fragments by patch: Patch::first_fragment
    // Radiance that needs no shading: emission, and the environment where nothing hides it.
    Image background;
    std::vector<Glint> glints;  // in order of pixels; the background lacks what they show of lights
    std::vector<ChancePixel> chance_pixels;  // in order of pixels
    bool irradiance = false;                 // it is a picture of irradiance, not radiance

    std::span<const Fragment> at_pixel(std::uint32_t pixel) const {
        return std::span(fragments).subspan(first_of_pixel[pixel],
                                            first_of_pixel[pixel + 1] - first_of_pixel[pixel]);
    }
};

/// Makes `map` the view of the cache: hands each fragment, which names a root and a place on it,
/// down to its leaf, counts and weighs fragments of all patches, and marks these as seen, as well
/// as what the view before this one showed until now.
void attach(ShadingCache& cache, IdMap& map, Cycle now, int threads = 1);

/// Divides a leaf and hands its fragments to the children. Returns the first child.
PatchId subdivide_seen(ShadingCache& cache, IdMap& map, PatchId leaf, Cycle now);

/// Moves a fragment that names a patch and a place on it down to the leaf there.
void hand_to_leaf(const ShadingCache& cache, Fragment& fragment);

/// What the fragment shows of the cache [cd/m2 a channel; lux in a picture of irradiance]; with
/// `fade`, as far as that has come.
Rgb shown_by(const ShadingCache& cache, const Fragment& fragment, const FadeIn* fade = nullptr);

/// Fragments that lie on `patch` or below it, as indices into map.fragments.
std::span<const std::uint32_t> fragments_of(const IdMap& map, const Patch& patch);

}  // namespace chiaro
