#include "import/finish_scene.h"

#include "base/error.h"
#include "import/fault.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace chiaro {
namespace {

// Beyond this the square of a distance is no float any more.
constexpr float kFarthest = 1e18f;

void scale_lengths(Scene& scene, float scale) {
    if (scale == 1.0f) return;
    const Mat4 scaling = glm::scale(Mat4(1), Vec3(scale));
    for (Object& object : scene.objects) object.to_world = scaling * object.to_world;
    for (PunctualLight& light : scene.lights) {
        light.position *= scale;
        light.range *= scale;
    }
    for (Camera& camera : scene.cameras) {
        camera.eye *= scale;
        camera.target *= scale;
    }
}

void order_all_primitives(Scene& scene, const std::string& where) {
    std::size_t dropped = 0;
    for (Mesh& mesh : scene.meshes) dropped += order_primitives(mesh);
    if (dropped > 0)
        scene.warnings.push_back(
            fmt::format("{}: {} polygons without area were left out", where, dropped));
}

bool singular(const Mat4& to_world) {
    const double determinant = glm::determinant(glm::dmat3(to_world));
    // As a float too, since that is what normals are transformed with.
    return determinant == 0 || static_cast<float>(determinant) == 0;
}

// Takes out objects that show nothing, so that everything in `objects` has a surface.
void drop_empty_objects(Scene& scene, const std::string& where) {
    std::erase_if(scene.objects, [&](const Object& object) {
        const bool empty = scene.mesh_of(object).primitives.empty();
        const bool flat = !empty && singular(object.to_world);
        if (empty || flat)
            scene.warnings.push_back(
                fmt::format("{}: object \"{}\" {} and was left out", where, printable(object.name),
                            empty ? "has no surface" : "is scaled to nothing"));
        return empty || flat;
    });
}

void drop_unused_meshes(Scene& scene) {
    std::vector<MeshId> moved(scene.meshes.size(), MeshId::none);
    std::vector<Mesh> kept;
    for (Object& object : scene.objects) {
        MeshId& id = moved[index_of(object.mesh)];
        if (id == MeshId::none) {
            id = static_cast<MeshId>(kept.size());
            kept.push_back(std::move(scene.meshes[index_of(object.mesh)]));
        }
        object.mesh = id;
    }
    scene.meshes = std::move(kept);
}

void check_extent(const Scene& scene, const std::string& where) {
    const auto inside = [](Vec3 p) {
        return is_finite(p) && std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthest;
    };
    const auto refuse = [&](const char* kind, const std::string& name) {
        throw Error(where, fmt::format("{} \"{}\" is more than 1e18 from the origin", kind,
                                       printable(name)));
    };
    for (const Object& object : scene.objects)
        for (const Vec3 p : scene.mesh_of(object).positions)
            if (!inside(Vec3(object.to_world * Vec4(p, 1)))) refuse("object", object.name);
    for (const PunctualLight& light : scene.lights)
        if (!inside(light.position)) refuse("light", light.name);
    for (const Camera& camera : scene.cameras)
        if (!inside(camera.eye) || !inside(camera.target)) refuse("camera", camera.name);
}

}  // namespace

void finish_scene(Scene& scene, const LoadOptions& options, const std::string& where) {
    if (options.up) scene.up = glm::normalize(*options.up);
    scale_lengths(scene, options.scale);
    order_all_primitives(scene, where);
    drop_empty_objects(scene, where);
    drop_unused_meshes(scene);
    check_extent(scene, where);
    check_scene(scene);
}

}  // namespace chiaro
