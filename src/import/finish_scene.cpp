#include "import/finish_scene.h"

#include "base/error.h"
#include "import/directions.h"
#include "import/fault.h"
#include "import/subdivide.h"

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace chiaro {
namespace {

// Rays start this much above a surface, at least (RayCaster::offset): a thousandth of such a scene.
constexpr float kSmallest = 1e-3f;

void check_options(const LoadOptions& options) {
    if (options.up && unit_or_zero(*options.up) == Vec3(0))
        throw Error("--up", "the vertical axis has no direction", "give one like 0,0,1");
    if (!(options.scale > 0 && options.scale <= 1e18f))
        throw Error("--scale", "the scale is not a number above 0", "give one up to 1e18");
}

void scale_lengths(Scene& scene, float scale) {
    if (scale == 1.0f) return;
    const Mat4 scaling = glm::scale(Mat4(1), Vec3(scale));
    for (Object& object : scene.objects) object.to_world = scaling * object.to_world;
    scene.nodes_to_world = scaling * scene.nodes_to_world;
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

// Takes out objects that show nothing, so that everything in `objects` has a surface.
void drop_empty_objects(Scene& scene, const std::string& where) {
    std::vector<ObjectId> moved(scene.objects.size(), ObjectId::none);
    std::vector<Object> kept;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const bool empty = scene.mesh_of(object).primitives.empty();
        const bool flat = !empty && scaled_to_nothing(object.to_world);
        if (empty || flat)
            scene.warnings.push_back(
                fmt::format("{}: object \"{}\" {} and was left out", where, printable(object.name),
                            empty ? "has no surface" : "is scaled to nothing"));
        if (empty || flat) continue;
        moved[i] = static_cast<ObjectId>(kept.size());
        kept.push_back(object);
    }
    scene.objects = std::move(kept);
    for (SceneNode& node : scene.nodes)
        if (node.object != ObjectId::none) node.object = moved[index_of(node.object)];
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

void check_count(const Scene& scene, const std::string& where) {
    std::size_t count = 0;
    for (const Object& object : scene.objects) count += scene.mesh_of(object).primitives.size();
    if (count > kMostPrimitives)
        throw Error(where,
                    fmt::format("{} polygons, counted where they are shown, are more than {}",
                                count, kMostPrimitives),
                    "leave out objects or repetitions");
}

void check_extent(Scene& scene, const std::string& where) {
    const auto check_inside = [&](const char* kind, const std::string& name, Vec3 p) {
        if (!within_reach(p))
            throw Error(where,
                        fmt::format("{} \"{}\" has coordinates beyond 1e9", kind, printable(name)),
                        "scale the scene down, as by --scale 0.001");
    };
    for (const Object& object : scene.objects) {
        for (int i = 0; i < 3; ++i) check_inside("object", object.name, Vec3(object.to_world[i]));
        for (const Vec3 p : scene.mesh_of(object).positions) {
            check_inside("object", object.name, p);
            check_inside("object", object.name, Vec3(object.to_world * Vec4(p, 1)));
        }
        for (const BicubicPatch& patch : scene.mesh_of(object).bicubics)
            for (const BicubicPatch& here : {patch, transformed(patch, object.to_world)})
                for (const Vec4& p : here.points)
                    check_inside("object", object.name, Vec3(p) / p.w);
    }
    for (const PunctualLight& light : scene.lights)
        check_inside("light", light.name, light.position);
    for (const Camera& camera : scene.cameras)
        for (const Vec3 p : {camera.eye, camera.target}) check_inside("camera", camera.name, p);

    const Box box = bounds(scene);
    if (!box.empty() && box.diagonal() < kSmallest)
        scene.warnings.push_back(fmt::format(
            "{}: the scene is only {:g} across: light is wrong below 0.001; use --scale", where,
            box.diagonal()));
}

void check_brightness(const Scene& scene, const std::string& where) {
    for (const Material& material : scene.materials)
        if (!(max_component(material.emission) <= kBrightest))
            throw Error(where, fmt::format("material \"{}\" emits more than 1e15 cd/m2",
                                           printable(material.name)));
    for (const PunctualLight& light : scene.lights)
        if (!(max_component(light.intensity) <= kBrightest))
            throw Error(where,
                        fmt::format("light \"{}\" is brighter than 1e15 {}", printable(light.name),
                                    light.kind == LightKind::directional ? "lux" : "cd"));
}

}  // namespace

bool scaled_to_nothing(const Mat4& to_world) {
    constexpr double kMost = 1e8;
    const glm::dmat3 back = glm::inverse(glm::dmat3(to_world));
    for (int i = 0; i < 3; ++i)
        if (!(glm::all(glm::lessThanEqual(glm::abs(back[i]), glm::dvec3(kMost))))) return true;
    return false;
}

std::vector<bool> drop_unseen(Scene& scene, const std::string& where) {
    order_all_primitives(scene, where);
    drop_empty_objects(scene, where);
    drop_unused_meshes(scene);
    std::vector<bool> in_use(scene.materials.size(), false);
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& primitive : mesh.primitives)
            in_use[index_of(primitive.material)] = true;
    return in_use;
}

void finish_scene(Scene& scene, const LoadOptions& options, const std::string& where) {
    check_options(options);
    if (options.up) scene.up = unit_or_zero(*options.up);
    if (options.subdivide) subdivide_meshes(scene, where);
    scale_lengths(scene, options.scale);
    drop_empty_objects(scene, where);
    drop_unused_meshes(scene);
    check_count(scene, where);
    check_extent(scene, where);
    check_brightness(scene, where);
    check_scene(scene);
}

}  // namespace chiaro
