// Two faces that meet at an edge, to weld or not.
#pragma once

#include "sample_renderer/tiny_scenes.h"

#include <cmath>

namespace chiaro::tiny {

// Two unit squares with corners of their own that meet at x = 0, the second folded down by
// `degrees`. `normals`: each square gives its corners its own normal.
inline Mesh folded(float degrees, bool normals, MaterialId first, MaterialId second) {
    const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    Mesh mesh;
    mesh.positions = {{-1, 0, 0}, {0, 0, 0},  {0, 1, 0},  {-1, 1, 0},
                      {0, 0, 0},  {c, 0, -s}, {c, 1, -s}, {0, 1, 0}};
    mesh.primitives = {quad(0, 1, 2, 3, first), quad(4, 5, 6, 7, second)};
    if (normals) {
        mesh.normals.assign(4, {0, 0, 1});
        mesh.normals.resize(8, {s, 0, c});
    }
    order_primitives(mesh);
    return mesh;
}

}  // namespace chiaro::tiny
