// Wavefront MTL: the materials of OBJ files.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

namespace chiaro {

/// The materials that the MTL files of one OBJ file have defined so far, by name. A texture is read
/// when a material that needs it is asked for.
class MtlMaterials {
public:
    /// Materials and textures are appended to `scene`, which must outlive this. Files are named
    /// from `folder`, or from the folder below it that the MTL file is in.
    MtlMaterials(Scene& scene, std::filesystem::path folder)
        : scene_(scene), folder_(std::move(folder)) {}

    /// Reads the MTL file that the OBJ file names `name` at `where`. A material that is defined
    /// again replaces the one before.
    void read(const std::string& name, const std::string& where);

    /// The material of that name, with its textures, or none. Throws an Error if a texture of it is
    /// absent or broken.
    MaterialId find(const std::string& name);

    /// The material of surfaces without one: grey 0.8, two-sided.
    MaterialId fallback();

private:
    struct Map {
        std::filesystem::path file;  // seen from the scene's folder; empty: no map
        std::string where;           // the line that names it
        Vec2 offset = Vec2(0), scale = Vec2(1);
        float gain = 1;
        bool clamp = false;
    };
    struct Definition {
        Material material;
        Map diffuse, emission, alpha;
        MaterialId id = MaterialId::none;  // once it is in the scene
    };

    friend class MtlReader;
    TextureUse use(const Map& map);
    void load_maps(Definition& definition);

    Scene& scene_;
    std::filesystem::path folder_;
    std::unordered_map<std::string, Definition> definitions_;
    std::map<std::pair<std::string, bool>, TextureId> textures_;  // by file and `clamp`
    MaterialId fallback_ = MaterialId::none;
};

}  // namespace chiaro
