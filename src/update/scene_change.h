// What edits that were made between two cycles change together.
#pragma once

#include "scene/edit.h"

#include <span>
#include <vector>

namespace chiaro {

struct SceneChange {
    bool lights = false;          // something shines otherwise or from elsewhere
    bool geometry = false;        // an object moved, came or went, or rays pass it otherwise
    bool materials = false;       // a surface reflects otherwise
    bool passing = false;         // one that stands lets other light through: it may be anywhere
    std::vector<Box> boxes;       // where something was, or where it is now (world space)
    std::vector<Box> relit;       // where surfaces shine otherwise that have not moved
    std::vector<ObjectId> moved;  // in order, each once
    std::vector<MaterialId> repainted;  // materials that are others now

    bool any() const { return lights || geometry || materials; }
    bool has_moved(ObjectId object) const;
};

/// Of an object that moved several times, only the first and the last place count: no cycle has
/// seen it between. The places that many left are united, and those that they came to, so that
/// there are at most kMostBoxes.
SceneChange change_of(std::span<const EditEffect> effects);
inline constexpr std::size_t kMostBoxes = 16;

}  // namespace chiaro
