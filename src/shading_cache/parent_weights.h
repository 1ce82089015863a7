// Which vertices can predict another, and with what weights.
#pragma once

#include "base/ids.h"
#include "base/vec.h"

#include <array>
#include <cstdint>
#include <span>

namespace chiaro {

/// A vertex as levels are made of.
struct LevelVertex {
    std::uint64_t cell;  // code of the finest grid's cell
    Vec3 position;
    Vec3 centre;  // mean position of those it stands for, itself on the finest level
    Vec3 normal;  // unit; the mean of theirs
    MaterialId material;
    std::uint32_t vertex;
};

/// Up to 4 parents; the weights of those that there are add up to MeshGraph::kFullWeight, the other
/// weights are 0.
struct ChosenParents {
    std::array<std::uint32_t, 4> vertices = {};
    std::array<std::uint8_t, 4> weights = {};

    bool empty() const { return weights == std::array<std::uint8_t, 4>{}; }
};

/// True if the two are of one material, less than two cells apart, turned from each other by less
/// than 45 degrees, and on what can be one surface: one that turns from one normal to the other on
/// the way. Of parallel sheets one before the other, such as slats or steps, those more than 6 % of
/// a cell apart are told apart at any distance, and others where they are closer to each other than
/// ten times that.
bool continues(const LevelVertex& a, const LevelVertex& b, float cell);

/// The nearest of `candidates` that continue the vertex's surface in each quadrant round it, with
/// weights >= 0 that reproduce linear functions where these surround it. None: no parents.
ChosenParents choose_parents(const LevelVertex& vertex, std::span<const LevelVertex> candidates,
                             float cell);

}  // namespace chiaro
