// What follows edits of the scene without building it anew.

#include "base/error.h"
#include "rays/embree_scene.h"

#include <algorithm>

namespace chiaro {
namespace {

bool uses(const Mesh& mesh, MaterialId material) {
    return std::ranges::any_of(mesh.primitives,
                               [&](const Primitive& p) { return p.material == material; });
}

std::vector<GeometryKind> kinds_of(const Mesh& mesh) {
    std::vector<GeometryKind> kinds;
    if (mesh.bicubics.size() < mesh.quad_count) kinds.push_back(kQuads);
    if (mesh.quad_count < mesh.primitives.size()) kinds.push_back(kTriangles);
    if (!mesh.bicubics.empty()) kinds.push_back(kBicubics);
    return kinds;
}

}  // namespace

void EmbreeScene::set_transform(const Scene& scene, ObjectId object) {
    check(index_of(object) < objects_.size(), "set_transform: unknown object");
    if (objects_[index_of(object)].geometry == nullptr) return;
    place(scene, index_of(object));
    const Mat4& to_world = scene.objects[index_of(object)].to_world;
    for (const Shown& shown : shown_)
        if (shown.object == object) set_matrix(shown.instance, to_world);
    commit("moving an object");
}

void EmbreeScene::set_shown(const Scene& scene, ObjectId object) {
    check(index_of(object) < objects_.size(), "set_shown: unknown object");
    const bool show = scene.objects[index_of(object)].shown;
    const auto set = [show](RTCGeometry instance) {
        if (instance == nullptr) return;
        show ? rtcEnableGeometry(instance) : rtcDisableGeometry(instance);
    };
    set(objects_[index_of(object)].geometry);
    for (const Shown& shown : shown_)
        if (shown.object == object) set(shown.instance);
    commit("showing or hiding an object");
}

void EmbreeScene::add_objects(const Scene& scene) {
    check(scene.objects.size() >= objects_.size(), "add_objects: objects have gone");
    arena_.execute([&] {
        follow_sides(scene);
        add_instances(scene);
    });
    commit("adding an object");
}

void EmbreeScene::set_material(const Scene& scene, MaterialId material) {
    arena_.execute([&] {
        follow_sides(scene);
        for (std::size_t i = 0; i < meshes_.size(); ++i)
            if (meshes_[i] != nullptr && uses(scene.meshes[i], material))
                follow_filter(scene, static_cast<MeshId>(i));
    });
    commit("changing a material");
}

// Whether the camera may look through surfaces from behind is told to Embree when it builds.
void EmbreeScene::follow_sides(const Scene& scene) {
    const bool now = has_single_sided(scene);
    if (now == any_single_sided_) return;
    any_single_sided_ = now;
    const auto set = [&](RTCScene of) {
        if (of == nullptr) return;
        rtcSetSceneFlags(of, scene_flags());
        rtcCommitScene(of);
    };
    for (RTCScene mesh : meshes_) set(mesh);
    for (const Shown& shown : shown_) set(shown.mesh);
    set(top_);
    set(eye_);
}

void EmbreeScene::follow_filter(const Scene& scene, MeshId id) {
    const Mesh& mesh = scene.meshes[index_of(id)];
    const bool see_through = any_see_through(mesh, scene);
    const auto set = [&](RTCScene of) {
        for (const GeometryKind kind : kinds_of(mesh)) {
            const RTCGeometry geometry = rtcGetGeometry(of, kind);
            set_filter(geometry, see_through);
            rtcCommitGeometry(geometry);
        }
        rtcCommitScene(of);
    };
    set(meshes_[index_of(id)]);
    for (const Shown& shown : shown_)
        if (scene.objects[index_of(shown.object)].mesh == id) set(shown.mesh);
}

void EmbreeScene::commit(const char* what) {
    arena_.execute([&] {
        rtcCommitScene(top_);
        if (eye_ != nullptr) rtcCommitScene(eye_);
    });
    check_device(what);
}

}  // namespace chiaro
