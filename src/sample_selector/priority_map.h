// Priorities of what is in view (4.1): the paper's estimate of each patch's interpolation error.
#pragma once

#include "shading_cache/id_map.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace chiaro {

/// From the irradiance on a patch to the picture's values, on the scale that errors are seen on.
struct PictureScale {
    float exposure = 1;       // the picture's values to that scale
    bool irradiance = false;  // the picture shows irradiance itself (Aov::irradiance)

    /// What multiplies irradiance where the reflectance is that (Patch::reflectance); glossy
    /// radiance has the exposure alone.
    float of(std::uint8_t reflectance) const {
        if (irradiance) return exposure;
        // A black surface keeps a little weight: its texture may not be black all over.
        return exposure * std::max<float>(reflectance, 1) / 255.0f / kPi;
    }
    float of(const Patch& patch) const { return of(patch.reflectance); }

    /// All light at a corner of the patch that the picture shows.
    Rgb color(const ShadingCache& cache, const Patch& patch, VertexId corner) const;
    float shown(const ShadingCache& cache, const Patch& patch, VertexId corner) const {
        return luminance(color(cache, patch, corner));
    }
};

/// Priority of a leaf: the largest minus the smallest tone-mapped colour of its corners, in [0, 1].
/// A leaf with a corner that was never shaded, of what it shows: 1.
float interpolation_error(const ShadingCache& cache, const Patch& leaf, const PictureScale& scale);

/// Priorities by pixel, made lazily for the leaves that cover one.
struct PriorityMap {
    int width = 0;
    int height = 0;
    std::vector<PatchId> patches;         // by pixel; none where nothing is
    std::vector<float> pixel_priorities;  // by pixel
    std::vector<float> patch_priorities;  // each visible leaf once, in no order that means anything

    std::optional<float> at(std::uint32_t pixel) const {
        if (patches[pixel] == PatchId::none) return std::nullopt;
        return pixel_priorities[pixel];
    }
};

/// What ages (5.1, 5.2): priority of a leaf a cycle since its oldest stale corner was shaded, by
/// object: at least 1 where shading was found to change or depends on the eye that moved, else 0.
struct Aging {
    std::span<const float> rates = {};  // by ObjectId; empty: nothing ages
    Cycle now = 0;
};
float age_priority(const ShadingCache& cache, const Patch& leaf, const Aging& aging);

/// Estimated errors and age priorities, added. A pixel that shows several leaves, on an outline or
/// through glass, stands for one of them, chosen in proportion to what it adds to the pixel by a
/// number that depends on `turn` alone.
PriorityMap make_priority_map(const ShadingCache& cache, const IdMap& map,
                              const PictureScale& scale, std::uint32_t turn,
                              const Aging& aging = {});

/// The priorities that 4.2 maps to 0 and 1: four standard deviations below and above the average,
/// each visible patch counting once.
struct PriorityRange {
    float low;
    float high;

    /// In [0, 1]; the average maps to 1/2 whatever the spread.
    float normalize(float priority) const;
};
PriorityRange four_sigma_range(std::span<const float> patch_priorities);

}  // namespace chiaro
