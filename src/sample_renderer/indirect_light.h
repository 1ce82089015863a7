// Irradiance after at least one reflection at one point, by paths traced to their ends.
#pragma once

#include "sample_renderer/aimed_rays.h"
#include "scene/open_sides.h"

namespace chiaro {

/// Rays shot from a point, and how many of them met the inside of something.
struct RayCount {
    std::uint32_t shot = 0;
    std::uint32_t inside = 0;

    /// At least three of four: the point lies in a solid.
    bool mostly_inside() const { return shot > 0 && 4 * inside >= 3 * shot; }
};

/// Of rays that met something, those that met the inside of a solid; none where `open_sides` is
/// null.
RayCount count_inside(const OpenSides* open_sides, std::span<const Hit> hits);

/// What add_indirect_samples() may be asked to do besides.
struct IndirectOptions {
    const OpenSides* open_sides = nullptr;  // counts rays that met the inside of a solid
    const EndsAt* ends_at = nullptr;        // what paths end at early is not added (path_wave.h)
    const Aims* aims = nullptr;             // surfaces that some rays are aimed at, too
};

/// Adds the estimates of all runs to the sums of their replicates (sample_run.h) [lux a channel]: a
/// path a sample whose first ray is distributed by the cosine.
RayCount add_indirect_samples(const LitScene& lit, std::span<const SampleRun> runs,
                              PathWave& scratch, std::span<Rgb> sums,
                              const IndirectOptions& options = {});

/// Shoots `count` cosine-distributed rays only to see what they meet.
RayCount probe(const LitScene& lit, const OpenSides& open_sides, const Receiver& receiver,
               std::uint32_t seed, std::uint32_t count, PathWave& scratch);

}  // namespace chiaro
