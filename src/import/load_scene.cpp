#include "import/load_scene.h"

#include "import/fault.h"
#include "import/finish_scene.h"
#include "import/read_gltf.h"
#include "import/read_obj.h"
#include "import/scene_file.h"

#include <algorithm>
#include <cctype>
#include <new>

namespace chiaro {
namespace {

void check_options(const LoadOptions& options) {
    if (options.up && !(is_finite(*options.up) && glm::dot(*options.up, *options.up) > 0))
        throw Error("--up", "the vertical axis has no direction", "give one like 0,0,1");
    if (!(options.scale > 0 && options.scale <= 1e18f))
        throw Error("--scale", "the scale is not a number above 0");
}

Scene read_scene(const std::filesystem::path& file, const std::string& where) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool known = extension == ".obj" || extension == ".gltf" || extension == ".glb";
    std::error_code ignored;
    if (!known && !std::filesystem::is_directory(file, ignored))
        throw Error(where, "is not a kind of scene that can be read",
                    "the kinds are .gltf, .glb and .obj");

    const std::string bytes = read_whole_file(file, where);
    if (bytes.empty()) throw Error(where, "the file is empty");
    const SceneFile source = {where, file.parent_path(), bytes};
    return extension == ".obj" ? read_obj(source) : read_gltf(source, extension == ".glb");
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options) {
    check_options(options);
    const std::string where = printable(file.string());
    try {
        Scene scene = read_scene(file, where);
        finish_scene(scene, options, where);
        return scene;
    } catch (const std::bad_alloc&) {
        throw Error(where, "there is not enough memory for this scene");
    }
}

}  // namespace chiaro
