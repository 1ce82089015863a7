#include "apps/open_scene.h"

#include "apps/output.h"
#include "base/error.h"
#include "import/directions.h"
#include "import/finish_scene.h"
#include "import/load_environment.h"
#include "import/resolve_edits.h"
#include "scene/built_in.h"
#include "scene/path_animation.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr std::string_view kBuiltIn = "builtin:";

std::string join(const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
    return list;
}

const Camera& named_camera(const Scene& scene, const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (scene.cameras[i].name == name || std::to_string(i) == name) return scene.cameras[i];
        names.push_back(scene.cameras[i].name);
    }
    throw Error("--camera", "the scene has no camera '" + name + "'",
                names.empty() ? "it has none: use --eye and --target" : "it has " + join(names));
}

Vec3 parse_place(const std::string& option, const std::string& text) {
    const Vec3 place(parse_vector(option, text));
    if (!within_reach(place)) throw Error(option, "'" + text + "' has coordinates beyond 1e9");
    return place;
}

// None of both options: none.
Environment choose_environment(const Options& options) {
    if (!options.environment.empty() && !options.sky.empty())
        throw Error("--environment and --sky", "a scene has one of them", "leave one out");
    if (!options.environment.empty()) return load_environment(options.environment);
    if (!options.sky.empty()) return {.sky = parse_sky(options.sky)};
    return {};
}

}  // namespace

Scene open_scene(const Options& options) {
    if (options.scene.empty()) throw Error("SCENE", "no file is named");
    LoadOptions load = {.scale = options.scale, .subdivide = options.subdivide};
    if (!options.up.empty()) load.up = unit_or_zero(parse_vector("--up", options.up));
    Environment environment = choose_environment(options);
    Scene scene;
    if (options.scene.starts_with(kBuiltIn)) {
        const std::string name = options.scene.substr(kBuiltIn.size());
        auto built_in = built_in_scene(name);
        if (!built_in)
            throw Error(options.scene, "there is no such built-in scene",
                        "there are " + join(built_in_names()));
        scene = std::move(*built_in);
        if (const auto paths = built_in_paths(name)) add_path_animation(scene, *paths);
        finish_scene(scene, load, options.scene);
    } else {
        scene = load_scene(options.scene, load);
    }
    scene.environment = std::move(environment);
    for (const std::string& warning : scene.warnings) warn(warning);
    return scene;
}

Camera choose_camera(const Scene& scene, const Options& options) {
    Camera camera;
    if (!options.camera.empty()) {
        camera = named_camera(scene, options.camera);
    } else if (!scene.cameras.empty()) {
        camera = scene.cameras.front();
    } else {
        camera = frame_from_inside(bounds(scene), scene.up);
    }
    if (!options.eye.empty()) {
        camera.eye = parse_place("--eye", options.eye);
        camera.up = scene.up;
    }
    if (!options.target.empty()) camera.target = parse_place("--target", options.target);
    if (options.vertical_fov) camera.vertical_fov = *options.vertical_fov;

    if (!(camera.vertical_fov > 0 && camera.vertical_fov < 180))
        throw Error("--vfov", "the field of view must lie between 0 and 180 degrees");
    const Vec3 forward = camera.target - camera.eye;
    if (!(glm::length(forward) > 0))
        throw Error("--target", "it is where the eye is", "move one of them");
    if (!(glm::length(glm::cross(forward, camera.up)) > 1e-6f * glm::length(forward)))
        throw Error("--up", "it points along the line of sight", "give --eye and another vertical");
    return camera;
}

void apply_edits(Scene& scene, Camera& camera, const Options& options) {
    if (options.edits.empty()) return;
    for (const Edit& edit : resolve_edits(read_edits(options.edits), scene, camera))
        apply(scene, camera, edit);
}

void apply_edits(Scene& scene, const Options& options) {
    Camera camera =
        scene.cameras.empty() ? frame_from_inside(bounds(scene), scene.up) : scene.cameras.front();
    apply_edits(scene, camera, options);
}

void add_headlamp_if_dark(Scene& scene, const Camera& camera) {
    if (has_light(scene)) return;
    warn("the scene has no light: a lamp at the eye lights it");
    PunctualLight lamp;
    lamp.name = "headlamp";
    lamp.kind = LightKind::point;
    lamp.position = camera.eye;
    const float size = std::max(bounds(scene).diagonal(), 1e-3f);
    lamp.intensity = Rgb(100 * size * size);  // 100 lux or more on all that it sees
    scene.lights.push_back(lamp);
}

}  // namespace chiaro
