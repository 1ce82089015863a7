// Materials and textures of a glTF document.
#pragma once

#include "import/gltf_document.h"
#include "import/unique_names.h"
#include "scene/scene.h"

#include <map>
#include <tuple>

namespace chiaro {

/// Puts materials into the scene when surfaces first need them, with the textures that they need.
class GltfMaterials {
public:
    /// Both must outlive this.
    GltfMaterials(GltfDocument& document, Scene& scene) : document_(document), scene_(scene) {}

    /// The scene's material for the document's `index`; -1: glTF's default (white, single-sided).
    /// It has a name only, until read() fills it.
    MaterialId get(int index);

    /// Reads those materials of the scene that are `in_use`, by id. Throws an Error if a texture of
    /// one is absent or broken; warns of absent images that none needs.
    void read(const std::vector<bool>& in_use);

private:
    void read(const tinygltf::Material& source, const std::string& place, Material& material);
    void read_emission(const tinygltf::Material& source, const std::string& place,
                       Material& material);
    void read_gloss(const tinygltf::Material& source, const std::string& place, Material& material);
    TextureUse use(const tinygltf::TextureInfo& info, bool srgb, const std::string& place);
    TextureId texture(int index, bool srgb);
    void warn_of_unused_images();

    GltfDocument& document_;
    Scene& scene_;
    UniqueNames unique_name_;
    std::map<int, MaterialId> known_;
    std::map<std::tuple<int, int, bool>, TextureId> textures_;  // by image, sampler and srgb
    // The first place of each kind of map that is not read.
    std::string normal_map_, extension_map_;
};

}  // namespace chiaro
