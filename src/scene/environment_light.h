// The environment as a light that can be sampled, by how bright it is where.
#pragma once

#include "scene/environment.h"
#include "scene/light_clusters.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace chiaro {

/// A direction that light comes from.
struct EnvironmentSample {
    Vec3 direction;  // unit, toward the light
    Rgb radiance;    // that comes from there [cd/m2 a channel]
    float pdf;       // over solid angle [1 / steradian]; > 0
};

/// Samples of one radiance everywhere follow the cosine at the place that they are for. Those of a
/// map follow its brightness (choice_weight()), bilinear as it is, whatever the place: a sun of one
/// pixel leaves no more noise than one of many. Where there is any light the density is above 0, to
/// rounding.
///
/// A cell lies between the centres of four neighbouring pixels. Tables know blocks of cells, one
/// each in maps of up to 2048 x 1024 pixels; the rest of the choice is made from the map itself.
/// Maps may have up to 16384 pixels a side.
///
/// Thread: const calls from any number of threads. Keeps a reference to the scene's environment;
/// describes it, and the scene's vertical, as they were when built.
class EnvironmentLight {
public:
    explicit EnvironmentLight(const Scene& scene);

    /// True if no light comes from it; nothing may be sampled then.
    bool empty() const { return empty_; }

    /// Radiance that comes from `direction` [cd/m2 a channel].
    Rgb radiance(Vec3 direction) const { return radiance_from(*environment_, frame_, direction); }

    /// Maps `u`, uniform in [0, 1)^2, to a direction above the plane of `place`; nothing if it came
    /// to lie below, which is worth nothing. Checks: not empty().
    std::optional<EnvironmentSample> sample(const LitPlace& place, Vec2 u) const;

    /// Density over solid angle with which sample() gives this unit direction, which is above the
    /// plane of `place`.
    float pdf(const LitPlace& place, Vec3 direction) const;

    /// As these, whatever the place: a direction that light comes from, even over all where there
    /// is one radiance everywhere.
    std::optional<EnvironmentSample> sample_anywhere(Vec2 u) const;
    float pdf_anywhere(Vec3 direction) const;

private:
    // What samples of a cell are chosen by: its corners' weights.
    struct Corners {
        float left_top, right_top, left_bottom, right_bottom;
        float sum() const { return (left_top + right_top) + (left_bottom + right_bottom); }
    };

    struct ChosenCell {
        MapCell cell;
        Corners weights;
    };

    void build_tables();
    Corners weights_of(MapCell cell) const;
    ChosenCell choose_cell(Vec2& u) const;
    std::optional<EnvironmentSample> sample_map(Vec2 u) const;
    float pdf_of_map(Vec3 direction) const;
    float pdf_of_weight(float weight, int row, float sine) const;

    const Environment* environment_;
    EnvironmentFrame frame_;
    bool empty_;
    int block_width_ = 1, block_height_ = 1;  // [cells]
    int blocks_across_ = 0;
    std::vector<float> row_ends_;     // by row of blocks: share of all light up to its end
    std::vector<float> column_ends_;  // by block: share of its row's light up to its end
    std::vector<float> row_sizes_;    // by row of cells: solid angle of one [steradian]
    std::vector<float> row_factors_;  // by row of cells: density x sine of zenith angle / weight
};

}  // namespace chiaro
