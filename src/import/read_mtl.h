// Wavefront MTL: the materials of OBJ files.
#pragma once

#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace chiaro {

/// The materials that the MTL files of one OBJ file have defined so far, by name.
class MtlMaterials {
public:
    /// Materials and textures are appended to `scene`, which must outlive this. Files are named
    /// from `folder`, or from the folder below it that the MTL file is in.
    MtlMaterials(Scene& scene, std::filesystem::path folder)
        : scene_(scene), folder_(std::move(folder)) {}

    /// Reads the MTL files that the OBJ file names at `where`; warns of those that are absent. A
    /// material that is defined again replaces the one before.
    void read_libraries(std::string names, const std::string& where);

    /// The scene's material of that name, without its textures, or none. What comes after a # may
    /// be a comment or part of the name.
    MaterialId find(const std::string& name);

    /// The material of surfaces without one: grey 0.8, two-sided.
    MaterialId fallback();

    /// Gives those materials of the scene that are `in_use`, by id, their textures. Throws an Error
    /// if one is absent or broken.
    void load_textures(const std::vector<bool>& in_use);

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
    bool read_library(const std::string& name, const std::string& where);
    TextureUse use(const Map& map);
    void load_maps(const Definition& definition);

    Scene& scene_;
    std::filesystem::path folder_;
    std::unordered_map<std::string, Definition> definitions_;
    std::vector<Definition> found_;  // those in the scene, as they were when they were put there
    std::map<std::pair<std::string, bool>, TextureId> textures_;  // by file and `clamp`
    MaterialId fallback_ = MaterialId::none;
    bool has_bump_maps_ = false;
};

}  // namespace chiaro
