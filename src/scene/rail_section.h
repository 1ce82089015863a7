// The section of a pool table's rails, of wood or metal.
#pragma once

#include "scene/scene.h"

#include <span>

namespace chiaro {

inline constexpr float kRailTop = 0.045f;      // above the cloth
inline constexpr float kCushionBack = 0.05f;   // from the noses to where the wood begins
inline constexpr float kRailOutside = 0.165f;  // from the noses to the outer edge of the rails
inline constexpr float kRailBevel = 0.003f;    // of the inner upper edge

/// Where a section stands, seen from above: from the cushions' backs to outside.
struct RailStation {
    Vec2 inner, outer;  // (x, z)
};

/// Sweeps the section along stations, y = 0 being the cloth; seen from above, the outside is on the
/// right of where z = x x y points. `lining` is of the wall towards the field or a pocket.
void add_rail(Mesh& mesh, std::span<const RailStation> stations, MaterialId lining,
              MaterialId surface, const Mat4& placement);

}  // namespace chiaro
