// What evaluating more would gain, for the best scheme: expected drop of squared error on the
// screen over its cost.
#pragma once

#include "sample_selector/priority_map.h"

#include <array>

namespace chiaro {

/// Costs and scales that gains are reckoned with.
struct GainSettings {
    PictureScale scale;      // irradiance to the scale of comparison_curve()
    float epsilon = 0.001f;  // error that is suspected everywhere, on the curve's scale (4.3)
    std::array<float, 8> seconds_a_sample{};  // a channel
    std::array<std::uint32_t, 8>
        first_samples{};                     // a channel: the fewest that a vertex starts with
    std::array<bool, 8> zero_is_doubtful{};  // a channel: no light found is not yet none there
};

/// Two ways to spend on a patch of a channel's front: evaluate its midpoints, or take more samples
/// at its noisiest corner.
struct Gain {
    float refine = 0;  // squared error times pixels a second, >= 0
    float resample = 0;
    VertexId noisiest = VertexId::none;

    float best() const { return refine > resample ? refine : resample; }
};

/// True if `patch` belongs to the front of `channel`: its ancestors are refined and it is not.
bool on_front(const ShadingCache& cache, PatchId patch, int channel);

/// Samples with which a vertex within `patch` starts: as many as its corners have that are not
/// stale, within limits, for among well-known vertices a noisy one would do harm.
std::uint32_t samples_of_new(const ShadingCache& cache, PatchId patch, int channel,
                             const GainSettings& settings);

/// Samples that take the place of a stale estimate: for half of the error that it is worth, but not
/// fewer than `of_new`, those that a new vertex there starts with; and never so few that one which
/// finds no bright light by bad luck seems sure of it, among many that do.
std::uint32_t samples_of_stale(const Estimate& stale, int channel, std::uint32_t of_new,
                               const GainSettings& settings);

/// Gain at a patch of the front. Zero where nothing of it is in view that the channel lights, and
/// while a corner of it is not evaluated.
///
/// Refining pays for the error that the surplus of its corners and their range predict; but a
/// difference within the corners' standard error is noise, and asks for samples (section 8).
Gain gain(const ShadingCache& cache, PatchId patch, int channel, const GainSettings& settings);

/// Samples with which a vertex of the mesh starts: as many as the parents that predict it have,
/// within the same limits.
std::uint32_t samples_of_new(const ShadingCache& cache, VertexId vertex, int channel,
                             const GainSettings& settings);

/// What hangs on a vertex of the mesh in a view.
struct OnVertex {
    float pixels = 0;
    bool told_by_levels = true;  // no patch round it is large
};

/// Whether coarser levels tell of the corners of a root patch in view: these are no farther than it
/// is wide unless it covers few pixels.
bool told_by_levels(const Patch& patch);

/// Gain of evaluating a vertex of the mesh: what its parents' surplus and range predict, and more
/// where levels do not tell. Zero while less than half of its parents is evaluated, as coarse ones
/// go first, unless it is hollow or levels do not tell.
float gain_of_first(const ShadingCache& cache, VertexId vertex, int channel, const OnVertex& on_it,
                    const GainSettings& settings);

/// Gain of as many samples again at an evaluated vertex of the mesh that speaks for `pixels`.
float gain_of_more(const ShadingCache& cache, VertexId vertex, int channel, float pixels,
                   const GainSettings& settings);

}  // namespace chiaro
