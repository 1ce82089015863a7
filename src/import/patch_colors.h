// Vertex colours of bicubic patches that are added to a mesh.
#pragma once

#include "scene/scene.h"

#include <algorithm>
#include <array>

namespace chiaro {

/// Gives colours to the corners of the patch that add_bicubic() added last.
inline void color_last_patch(Mesh& mesh, const std::array<Vec4, 4>& colors) {
    mesh.colors.resize(mesh.positions.size(), Vec4(1));
    std::ranges::copy(colors, mesh.colors.end() - 4);
}

}  // namespace chiaro
