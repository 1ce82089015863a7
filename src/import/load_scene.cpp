#include "import/load_scene.h"

#include "import/fault.h"
#include "import/finish_scene.h"
#include "import/read_bpt.h"
#include "import/read_gltf.h"
#include "import/read_obj.h"
#include "import/scene_file.h"

#include <new>

namespace chiaro {
namespace {

Scene read_scene(const std::filesystem::path& file, const LoadOptions& options,
                 const std::string& where) {
    const std::string extension = lower_extension(file);
    const bool known =
        extension == ".obj" || extension == ".gltf" || extension == ".glb" || extension == ".bpt";
    std::error_code ignored;
    if (!known && !std::filesystem::is_directory(file, ignored))
        throw Error(where, "is not a kind of scene that can be read",
                    "the kinds are .gltf, .glb, .obj and .bpt");

    const std::string bytes = read_whole_file(file, where);
    if (bytes.empty()) throw Error(where, "the file is empty");
    // Files are named from where the scene really is, should it be reached by a link.
    const bool link = std::filesystem::is_symlink(file, ignored);
    const SceneFile source = {where, (link ? real_path(file) : file).parent_path(), bytes};
    if (extension == ".bpt") return read_bpt(source, file.stem().string());
    if (extension == ".obj") return read_obj(source, options.subdivide);
    return read_gltf(source, extension == ".glb");
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options) {
    const std::string where = printable(file.string());
    try {
        Scene scene = read_scene(file, options, where);
        finish_scene(scene, options, where);
        return scene;
    } catch (const std::bad_alloc&) {
        throw Error(where, "there is not enough memory for this scene");
    }
}

}  // namespace chiaro
