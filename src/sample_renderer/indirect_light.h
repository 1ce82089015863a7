// Irradiance after at least one reflection at one point, by paths traced to their ends.
#pragma once

#include "sample_renderer/path_wave.h"
#include "scene/open_sides.h"

namespace chiaro {

/// Rays shot from a point, and how many of them met the inside of something.
struct RayCount {
    std::uint32_t shot = 0;
    std::uint32_t inside = 0;

    /// At least three of four: the point lies in a solid.
    bool mostly_inside() const { return shot > 0 && 4 * inside >= 3 * shot; }
};

/// Of rays that met something, those that met the inside of a solid. `open_sides` may be null.
RayCount count_inside(const OpenSides* open_sides, std::span<const Hit> hits);

/// Puts one cosine-distributed ray a sample into the emptied wave. Cosine over density is pi, which
/// the throughput leaves out.
void start_paths(const Receiver& receiver, std::uint32_t seed, std::uint32_t first,
                 std::uint32_t count, PathWave& wave);

/// Adds the estimates of samples [first, first + count) to the sums of their replicates [lux a
/// channel]. `open_sides` may be null. What paths end at early is not added here (path_wave.h).
RayCount add_indirect_samples(const LitScene& lit, const OpenSides* open_sides,
                              const Receiver& receiver, std::uint32_t seed, std::uint32_t first,
                              std::uint32_t count, PathWave& scratch,
                              std::span<Rgb, kReplicates> sums, const EndsAt* ends_at = nullptr);

/// Shoots `count` cosine-distributed rays only to see what they meet.
RayCount probe(const LitScene& lit, const OpenSides& open_sides, const Receiver& receiver,
               std::uint32_t seed, std::uint32_t count, PathWave& scratch);

}  // namespace chiaro
