// Bicubic patches as primitives of a mesh.
#pragma once

#include "scene/scene.h"

#include <array>

namespace chiaro {

/// Texture coordinates at the four corners of a patch.
using CornerUvs = std::array<Vec2, 4>;
inline constexpr CornerUvs kUnitUvs = {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};

/// Adds a patch to a mesh, which stays as order_primitives() left it. Its corners become points of
/// the mesh, with normals and texture coordinates where the mesh has them or has no points yet.
void add_bicubic(Mesh& mesh, const BicubicPatch& patch, MaterialId material,
                 const CornerUvs& uvs = kUnitUvs);

/// Divides patches until no two edges of the mesh that are not the same curve join the same two
/// places, as the meridians of a sphere would: edges are known by their ends. Neighbours are
/// divided with them, so that whole edges meet. Drops patches without area; returns how many. Part
/// of order_primitives().
std::size_t settle_bicubics(Mesh& mesh);

/// True if the primitive is a bicubic patch.
inline bool is_bicubic(const Mesh& mesh, std::uint32_t primitive) {
    return primitive < mesh.bicubics.size();
}

}  // namespace chiaro
