#include "import/read_gltf.h"

#include "import/fault.h"
#include "import/finish_scene.h"
#include "import/gltf_animation.h"
#include "import/gltf_check.h"
#include "import/gltf_document.h"
#include "import/gltf_material.h"
#include "import/gltf_mesh.h"
#include "import/unique_names.h"
#include "scene/animate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <variant>

namespace chiaro {
namespace {

using glm::dmat4;
using glm::dvec3;

glm::dvec3 to_vec3(const std::vector<double>& numbers, glm::dvec3 fallback) {
    return numbers.size() == 3 ? dvec3(numbers[0], numbers[1], numbers[2]) : fallback;
}

// The node's own transform, from its matrix or its translation, rotation and scale.
std::variant<Pose, dmat4> local_transform(const tinygltf::Node& node, const std::string& where) {
    if (node.matrix.size() == 16) {
        dmat4 matrix;
        for (int i = 0; i < 16; ++i)
            matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        constexpr double kSlack = 1e-5;
        for (int column = 0; column < 4; ++column) {
            const double expected = column == 3 ? 1 : 0;
            if (std::abs(matrix[column].w - expected) > kSlack)
                throw Error(where + ".matrix", "is not affine");
            matrix[column].w = expected;
        }
        return matrix;
    }
    Pose pose;
    pose.translation = to_vec3(node.translation, dvec3(0));
    pose.scale = to_vec3(node.scale, dvec3(1));
    if (node.rotation.size() == 4)
        pose.rotation =
            glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(glm::length(pose.rotation) > 0)) throw Error(where + ".rotation", "has no direction");
    return pose;
}

dmat4 matrix_of(const std::variant<Pose, dmat4>& local) {
    const Pose* pose = std::get_if<Pose>(&local);
    return pose != nullptr ? matrix_of(*pose) : std::get<dmat4>(local);
}

Mat4 to_float(const dmat4& transform, const std::string& where) {
    const Mat4 rounded(transform);
    for (int column = 0; column < 4; ++column)
        if (!is_finite(Vec3(rounded[column])))
            throw Error(where, "its place in the world is not a number that a float holds");
    return rounded;
}

// Builds the scene by walking the nodes of the document's default scene.
class SceneBuilder {
public:
    explicit SceneBuilder(GltfDocument& document)
        : document_(document), model_(document.model()), materials_(document, scene_) {}

    Scene build(const std::string& where) {
        walk(root_nodes());
        read_animations(document_, node_ids_, scene_);
        materials_.read(drop_unseen(scene_, where));
        add_warnings();
        return std::move(scene_);
    }

private:
    std::vector<int> root_nodes() const {
        if (!model_.scenes.empty()) {
            const int scene = std::max(model_.defaultScene, 0);
            return model_.scenes[static_cast<std::size_t>(scene)].nodes;
        }
        std::vector<bool> is_child(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes)
            for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
        std::vector<int> roots;
        for (std::size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) roots.push_back(static_cast<int>(i));
        return roots;
    }

    // In the order of the file, each node before its children; a stack of our own, since a file may
    // nest nodes as deep as it likes.
    void walk(const std::vector<int>& roots) {
        struct Open {
            int node;
            NodeId parent;
            dmat4 to_world;  // of the parent
        };
        std::vector<Open> open;
        const auto push = [&](const std::vector<int>& nodes, NodeId parent, const dmat4& to_world) {
            for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
                open.push_back({*node, parent, to_world});
        };
        push(roots, NodeId::none, dmat4(1));
        node_ids_.assign(model_.nodes.size(), NodeId::none);
        while (!open.empty()) {
            const Open next = open.back();
            open.pop_back();
            const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(next.node)];
            const std::string where = document_.where(fmt::format("nodes[{}]", next.node));
            const auto local = local_transform(node, where);
            const dmat4 to_world = next.to_world * matrix_of(local);
            const auto id = static_cast<NodeId>(scene_.nodes.size());
            node_ids_[static_cast<std::size_t>(next.node)] = id;
            scene_.nodes.push_back({node.name, next.parent, local});
            add_node(node, to_float(to_world, where), where);
            push(node.children, id, to_world);
        }
    }

    void add_node(const tinygltf::Node& node, const Mat4& to_world, const std::string& where) {
        if (node.mesh >= 0) add_object(node, to_world);
        if (node.camera >= 0) add_camera(node, to_world, where);
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end())
            add_light(node, light->second.Get("light").GetNumberAsInt(), to_world, where);
    }

    void add_object(const tinygltf::Node& node, const Mat4& to_world) {
        const auto mesh = static_cast<std::size_t>(node.mesh);
        const auto [known, fresh] =
            meshes_.try_emplace(mesh, static_cast<MeshId>(scene_.meshes.size()));
        if (fresh) scene_.meshes.push_back(read_mesh(document_, mesh, materials_, counts_));
        const std::string& wanted = node.name.empty() ? model_.meshes[mesh].name : node.name;
        scene_.nodes.back().object = static_cast<ObjectId>(scene_.objects.size());
        scene_.objects.push_back({object_name_(wanted, "object"), known->second, to_world});
    }

    // A camera looks along its node's -z, with +y upwards.
    void add_camera(const tinygltf::Node& node, const Mat4& to_world, const std::string& where) {
        const tinygltf::Camera& source = model_.cameras[static_cast<std::size_t>(node.camera)];
        if (source.type != "perspective") {
            warn(where, "its camera is not a perspective one and was left out");
            return;
        }
        Camera camera;
        if (!place_camera(to_world, camera)) {
            warn(where, "its camera is scaled to nothing and was left out");
            return;
        }
        camera.name = camera_name_(node.name.empty() ? source.name : node.name, "camera");
        camera.vertical_fov = static_cast<float>(glm::degrees(source.perspective.yfov));
        scene_.nodes.back().camera = static_cast<CameraId>(scene_.cameras.size());
        scene_.cameras.push_back(std::move(camera));
    }

    // A light shines along its node's -z; the scale of the node does not reach it.
    void add_light(const tinygltf::Node& node, int index, const Mat4& to_world,
                   const std::string& where) {
        const tinygltf::Light& source = model_.lights[static_cast<std::size_t>(index)];
        PunctualLight light;
        if (source.type == "point") {
            light.kind = LightKind::point;
        } else if (source.type == "spot") {
            light.kind = LightKind::spot;
            set_cones(source.spot, light);
        } else if (source.type == "directional") {
            light.kind = LightKind::directional;
        } else {
            warn(where, fmt::format("its light is of the unknown type \"{}\" and was left out",
                                    printable(source.type)));
            return;
        }
        if (!place_light(to_world, light)) {
            warn(where, "its light is scaled to nothing and was left out");
            return;
        }
        light.name = light_name_(node.name.empty() ? source.name : node.name, "light");
        light.intensity = Rgb(static_cast<float>(source.intensity));
        light.intensity *= Rgb(to_vec3(source.color, dvec3(1)));
        if (source.range > 0) light.range = static_cast<float>(source.range);
        scene_.nodes.back().light = static_cast<LightId>(scene_.lights.size());
        scene_.lights.push_back(std::move(light));
    }

    static void set_cones(const tinygltf::SpotLight& spot, PunctualLight& light) {
        const double outer = std::min(spot.outerConeAngle, glm::half_pi<double>());
        light.outer_cone = static_cast<float>(outer);
        light.inner_cone = static_cast<float>(std::clamp(spot.innerConeAngle, 0.0, outer));
    }

    void warn(const std::string& where, const std::string& what) {
        scene_.warnings.push_back(where + ": " + what);
    }

    void add_warnings() {
        if (document_.has_skins)
            warn(document_.where("skins"), "are not supported; meshes stand as they are bound");
        if (counts_.has_morph_targets)
            warn(document_.where("meshes"), "morph targets are not supported and were left out");
        if (counts_.has_points_or_lines)
            warn(document_.where("meshes"), "points and lines were left out");
        if (counts_.has_loose_indices)
            warn(document_.where("meshes"), "corners left over from whole triangles were left out");
        std::string unsupported;
        for (const std::string& name : model_.extensionsUsed)
            if (!is_supported_extension(name))
                unsupported += (unsupported.empty() ? "" : ", ") + printable(name);
        if (!unsupported.empty())
            warn(document_.where("extensionsUsed"), unsupported + ": not supported and left out");
    }

    GltfDocument& document_;
    const tinygltf::Model& model_;
    Scene scene_;
    GltfMaterials materials_;
    GltfMeshCounts counts_;
    std::map<std::size_t, MeshId> meshes_;
    std::vector<NodeId> node_ids_;  // by those of the file
    UniqueNames object_name_, camera_name_, light_name_;
};

}  // namespace

Scene read_gltf(const SceneFile& file, bool binary) {
    GltfDocument document(file, binary);
    check_primitives(document);
    return SceneBuilder(document).build(file.where);
}

}  // namespace chiaro
