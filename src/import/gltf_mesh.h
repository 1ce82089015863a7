// Meshes of a glTF document.
#pragma once

#include "import/gltf_document.h"
#include "import/gltf_material.h"
#include "scene/scene.h"

namespace chiaro {

/// The most points, and the most triangles, that are read from one document.
inline constexpr std::size_t kMaxMeshElements = 50'000'000;

/// Throws an Error at the first primitive, used or not, whose attributes or indices have a format
/// or a count that glTF does not allow.
void check_primitives(const GltfDocument& document);

/// What is left out of all meshes alike, for one line of warning each.
struct GltfMeshCounts {
    std::size_t points = 0, triangles = 0;
    bool has_morph_targets = false;
    bool has_points_or_lines = false;
    bool has_loose_indices = false;  // a list of triangles that does not end with one
};

/// Mesh `index` of the document, all its primitives joined. Throws an Error if an index is out of
/// range or restarts a primitive, a number is not finite or the counts pass kMaxMeshElements.
Mesh read_mesh(const GltfDocument& document, std::size_t index, GltfMaterials& materials,
               GltfMeshCounts& counts);

}  // namespace chiaro
