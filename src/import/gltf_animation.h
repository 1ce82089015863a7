// Animations of glTF (2.0, 3.11).
#pragma once

#include "import/gltf_document.h"
#include "scene/scene.h"

#include <vector>

namespace chiaro {

/// Adds the document's animations to `scene`. `nodes` are the scene's by those of the file; none
/// where a node is not in the scene, whose channels are then left out. So are, with a warning,
/// weights of morph targets and paths that glTF does not know. Throws an Error at "file:
/// animations[i]..." if keys are of the wrong type, do not rise or are too many.
void read_animations(const GltfDocument& document, const std::vector<NodeId>& nodes, Scene& scene);

}  // namespace chiaro
