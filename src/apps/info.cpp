// chiaro info: what was read.

#include "apps/commands.h"
#include "apps/open_scene.h"
#include "import/fault.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace chiaro {
namespace {

// What edits removed is no longer there.
bool is_there(const Object& object) {
    return object.shown;
}
bool is_there(const PunctualLight& light) {
    return light.on;
}
template <typename T>
bool is_there(const T&) {
    return true;
}

template <typename T>
nlohmann::ordered_json names_of(const std::vector<T>& things) {
    auto names = nlohmann::ordered_json::array();
    for (const T& thing : things)
        if (is_there(thing)) names.push_back(thing.name);
    return names;
}

nlohmann::ordered_json describe(const std::vector<Animation>& animations) {
    auto list = nlohmann::ordered_json::array();
    for (const Animation& animation : animations)
        list.push_back({{"name", animation.name}, {"duration", animation.duration}});
    return list;
}

nlohmann::ordered_json describe(const Environment& environment) {
    if (is_dark(environment)) return nullptr;
    const Image& map = environment.map;
    nlohmann::ordered_json j;
    j["map"] = nullptr;
    if (environment.has_map()) j["map"] = {map.width, map.height};
    const Rgb mean = mean_radiance(environment);
    j["mean_radiance"] = {mean.r, mean.g, mean.b};
    return j;
}

nlohmann::ordered_json describe(const Scene& scene) {
    std::size_t patches = 0, quads = 0, triangles = 0, emitters = 0;
    for (const Object& object : scene.objects) {
        if (!object.shown) continue;
        const Mesh& mesh = scene.mesh_of(object);
        patches += mesh.bicubics.size();
        quads += mesh.quad_count - mesh.bicubics.size();
        triangles += mesh.primitives.size() - mesh.quad_count;
        for (const Primitive& p : mesh.primitives)
            emitters +=
                max_component(object.emission_scale * scene.material(p.material).emission) > 0 ? 1
                                                                                               : 0;
    }
    const Box box = bounds(scene);
    nlohmann::ordered_json j;
    j["primitives"] = patches + quads + triangles;
    j["quads"] = quads;
    j["triangles"] = triangles;
    j["bicubic_patches"] = patches;
    j["bezier_patches"] = patches;  // its name before other kinds of surface became patches
    j["emissive_primitives"] = emitters;
    if (!box.empty()) {
        j["bounds"] = {{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}};
    } else {
        j["bounds"] = nullptr;
    }
    j["objects"] = names_of(scene.objects);
    j["lights"] = names_of(scene.lights);
    j["materials"] = names_of(scene.materials);
    j["textures"] = names_of(scene.textures);
    j["cameras"] = names_of(scene.cameras);
    j["animations"] = describe(scene.animations);
    j["environment"] = describe(scene.environment);
    j["warnings"] = scene.warnings;
    return j;
}

void print_list(const nlohmann::ordered_json& j, const char* what) {
    constexpr std::size_t kMost = 20;
    std::printf("%-10s %zu", what, j[what].size());
    for (std::size_t i = 0; i < j[what].size() && i < kMost; ++i)
        std::printf("%s%s", i == 0 ? ": " : ", ", printable(j[what][i].get<std::string>()).c_str());
    std::printf("%s\n", j[what].size() > kMost ? ", ..." : "");
}

}  // namespace

int info_command(const Options& options) {
    Scene scene = open_scene(options);
    apply_edits(scene, options);
    const nlohmann::ordered_json j = describe(scene);
    if (options.json) {
        // Names come from files: whatever is no UTF-8 in them is replaced, not an error.
        std::printf("%s\n",
                    j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
        return 0;
    }
    std::printf("primitives %zu: %zu quads, %zu triangles, %zu bicubic patches; %zu emit\n",
                j["primitives"].get<std::size_t>(), j["quads"].get<std::size_t>(),
                j["triangles"].get<std::size_t>(), j["bicubic_patches"].get<std::size_t>(),
                j["emissive_primitives"].get<std::size_t>());
    if (!j["bounds"].is_null()) std::printf("bounds     %s\n", j["bounds"].dump().c_str());
    for (const char* list : {"objects", "lights", "materials", "textures", "cameras"})
        print_list(j, list);
    for (const Animation& a : scene.animations)
        std::printf("animation  %s, %g s\n", printable(a.name).c_str(), double(a.duration));
    if (const auto& e = j["environment"]; !e.is_null())
        std::printf("environment %s, %s cd/m2 in the mean\n",
                    e["map"].is_null() ? "even" : ("map " + e["map"].dump()).c_str(),
                    e["mean_radiance"].dump().c_str());
    return 0;
}

}  // namespace chiaro
