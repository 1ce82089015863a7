#include "rays/embree_scene.h"

#include "base/error.h"
#include "base/parallel.h"
#include "rays/filter.h"
#include "scene/bsdf.h"
#include "scene/surface.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace chiaro {
namespace {

bool shows_something(const Scene& scene, const Object& object) {
    return object.mesh != MeshId::none && !scene.mesh_of(object).primitives.empty();
}

// Whether the normals at a primitive's corners are its own, on whichever side, or off by a
// milliradian at most.
bool is_flat(const Mesh& mesh, const Primitive& primitive) {
    const auto position = [&](int corner) { return mesh.positions[primitive.corners[corner]]; };
    const auto agrees = [&](int a, int b, int c) {
        const Vec3 cross = glm::cross(position(b) - position(a), position(c) - position(a));
        const Vec3 normal = safe_normalize(cross, Vec3(0));
        for (int corner = 0; corner < primitive.corner_count(); ++corner) {
            const Vec3 there = safe_normalize(mesh.normals[primitive.corners[corner]], Vec3(0));
            if (!(std::abs(glm::dot(there, normal)) > 1 - 5e-7f)) return false;
        }
        return true;
    };
    if (!primitive.is_quad()) return agrees(0, 1, 2);
    return agrees(0, 1, 3) && agrees(2, 3, 1);
}

std::vector<bool> curved_primitives(const Mesh& mesh) {
    if (mesh.normals.empty() && mesh.bicubics.empty()) return {};
    std::vector<bool> curved(mesh.bicubics.size(), true);
    for (std::size_t i = curved.size(); i < mesh.primitives.size(); ++i)
        curved.push_back(!mesh.normals.empty() && !is_flat(mesh, mesh.primitives[i]));
    return curved;
}

// Of about one size whatever the object's, so that products with it stay floats.
Mat3 scaled_normal_matrix(const Mat4& to_world) {
    float largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(to_world[column][row]));
    return normal_matrix(largest > 0 ? to_world / largest : to_world);
}

const char* name_of(RTCError error) {
    switch (error) {
        case RTC_ERROR_NONE:
            return "no error";
        case RTC_ERROR_OUT_OF_MEMORY:
            return "out of memory";
        case RTC_ERROR_UNSUPPORTED_CPU:
            return "this processor is not supported";
        case RTC_ERROR_INVALID_ARGUMENT:
            return "invalid argument";
        case RTC_ERROR_INVALID_OPERATION:
            return "invalid operation";
        case RTC_ERROR_CANCELLED:
            return "cancelled";
        case RTC_ERROR_UNKNOWN:
            break;
    }
    return "unknown error";
}

}  // namespace

bool any_see_through(const Mesh& mesh, const Scene& scene) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const Primitive& p) {
        const Material& material = scene.material(p.material);
        return material.see_through() || may_pass_straight(material);
    });
}

bool has_single_sided(const Scene& scene) {
    return std::ranges::any_of(scene.materials,
                               [](const Material& material) { return !material.double_sided; });
}

void EmbreeScene::set_matrix(RTCGeometry instance, const Mat4& m) {
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &m[0][0]);
    rtcCommitGeometry(instance);
}

EmbreeScene::EmbreeScene(const Scene& scene, int threads, float curve_tolerance)
    : arena_(std::clamp(threads, 1, hardware_threads())),
      threads_(threads),
      curve_tolerance_(curve_tolerance) {
    device_ = rtcNewDevice(nullptr);
    if (device_ == nullptr) throw Error("Embree", name_of(rtcGetDeviceError(nullptr)));
    try {
        arena_.execute([&] { build(scene); });
    } catch (...) {
        release();
        throw;
    }
}

void EmbreeScene::build(const Scene& scene) {
    any_single_sided_ = has_single_sided(scene);
    top_ = new_scene();
    add_instances(scene);
    rtcCommitScene(top_);
    check_device("building the scene");
}

// A scene for each mesh that is shown; objects are instances of them.
void EmbreeScene::add_instances(const Scene& scene) {
    meshes_.resize(scene.meshes.size(), nullptr);
    curved_.resize(scene.meshes.size());
    grids_.resize(scene.meshes.size());
    curve_tolerances_.resize(scene.meshes.size(), 0.0f);
    const std::size_t first = objects_.size();
    for (std::size_t i = first; i < scene.objects.size(); ++i)
        if (shows_something(scene, scene.objects[i]) &&
            meshes_[index_of(scene.objects[i].mesh)] == nullptr)
            build_mesh(scene.objects[i].mesh, scene);

    objects_.resize(scene.objects.size());
    for (std::size_t i = first; i < scene.objects.size(); ++i)
        if (shows_something(scene, scene.objects[i])) add_instance(scene, i);
}

void EmbreeScene::add_instance(const Scene& scene, std::size_t object) {
    Instance& instance = objects_[object];
    const Mesh& mesh = scene.mesh_of(scene.objects[object]);
    instance.mesh = index_of(scene.objects[object].mesh);
    instance.primitives = mesh.primitives.data();
    instance.first_of = {static_cast<std::uint32_t>(mesh.bicubics.size()), mesh.quad_count, 0};
    const std::vector<bool>& curved = curved_[instance.mesh];
    instance.any_curved = std::find(curved.begin(), curved.end(), true) != curved.end();
    instance.geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance.geometry, meshes_[instance.mesh]);
    place(scene, object);
    if (!scene.objects[object].shown) rtcDisableGeometry(instance.geometry);
    for (RTCScene of : {top_, eye_})
        if (of != nullptr)
            rtcAttachGeometryByID(of, instance.geometry, static_cast<unsigned>(object));
    rtcReleaseGeometry(instance.geometry);  // the scene keeps it
}

// If not robust, rays slip through the diagonals of quads and the edges that they share: one in ten
// of those aimed there. It costs a tenth of the speed.
RTCScene EmbreeScene::new_scene() const {
    const RTCScene made = rtcNewScene(device_);
    rtcSetSceneBuildQuality(made, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(made, scene_flags());
    return made;
}

RTCSceneFlags EmbreeScene::scene_flags() const {
    return any_single_sided_ ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION
                             : RTC_SCENE_FLAG_ROBUST;
}

EmbreeScene::~EmbreeScene() {
    release();
}

void EmbreeScene::release() {
    stop_showing();
    if (top_ != nullptr) rtcReleaseScene(top_);
    for (RTCScene mesh : meshes_)
        if (mesh != nullptr) rtcReleaseScene(mesh);
    if (device_ != nullptr) rtcReleaseDevice(device_);
}

void EmbreeScene::build_mesh(MeshId id, const Scene& scene) {
    const Mesh& mesh = scene.meshes[index_of(id)];
    RTCScene mesh_scene = new_scene();
    meshes_[index_of(id)] = mesh_scene;
    curved_[index_of(id)] = curved_primitives(mesh);

    // A copy, padded: Embree reads 16 bytes at the last point. Quads and triangles share it.
    const std::size_t bytes = mesh.positions.size() * sizeof(Vec3);
    RTCBuffer positions = rtcNewBuffer(device_, bytes + 16);
    check_device("allocating points");
    std::memcpy(rtcGetBufferData(positions), mesh.positions.data(), bytes);
    if (mesh.bicubics.size() < mesh.quad_count)
        attach_polygons(mesh_scene, positions, mesh, scene, kQuads);
    if (mesh.quad_count < mesh.primitives.size())
        attach_polygons(mesh_scene, positions, mesh, scene, kTriangles);
    rtcReleaseBuffer(positions);
    if (!mesh.bicubics.empty()) {
        make_curves(id, scene);
        attach_curves(mesh_scene, grids_[index_of(id)], mesh, scene);
    }

    rtcCommitScene(mesh_scene);
    check_device("building a mesh");
}

void EmbreeScene::attach_polygons(RTCScene mesh_scene, RTCBuffer positions, const Mesh& mesh,
                                  const Scene& scene, GeometryKind kind) {
    const bool quads = kind == kQuads;
    const std::size_t first = quads ? mesh.bicubics.size() : mesh.quad_count;
    const std::size_t count = (quads ? mesh.quad_count : mesh.primitives.size()) - first;
    RTCGeometry geometry =
        rtcNewGeometry(device_, quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions, 0,
                         sizeof(Vec3), mesh.positions.size());

    // The corners are read where they stand in the scene's primitives.
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                               quads ? RTC_FORMAT_UINT4 : RTC_FORMAT_UINT3, mesh.primitives.data(),
                               first * sizeof(Primitive), sizeof(Primitive), count);
    attach(mesh_scene, geometry, mesh, scene, kind);
}

void EmbreeScene::attach(RTCScene mesh_scene, RTCGeometry geometry, const Mesh& mesh,
                         const Scene& scene, GeometryKind kind) {
    set_filter(geometry, any_see_through(mesh, scene));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(mesh_scene, geometry, kind);
    rtcReleaseGeometry(geometry);
}

void EmbreeScene::set_filter(RTCGeometry geometry, bool see_through) {
    any_filter_ |= see_through;
    rtcSetGeometryIntersectFilterFunction(geometry, see_through ? see_through_filter : nullptr);
    rtcSetGeometryOccludedFilterFunction(geometry, see_through ? see_through_filter : nullptr);
}

void EmbreeScene::place(const Scene& scene, std::size_t object) {
    Instance& instance = objects_[object];
    const Mat4& m = scene.objects[object].to_world;
    instance.normal_matrix = scaled_normal_matrix(m);
    // What the eye sees may be off as far on the other side.
    instance.curve_error = 2 * grids_[instance.mesh].error * largest_stretch(m);
    set_matrix(instance.geometry, m);

    // A box round the turned box of the mesh is no smaller than the object.
    RTCBounds box;
    rtcGetSceneBounds(meshes_[index_of(scene.objects[object].mesh)], &box);
    const Vec3 low(box.lower_x, box.lower_y, box.lower_z);
    const Vec3 high(box.upper_x, box.upper_y, box.upper_z);
    instance.extent = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 local(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                         corner & 4 ? high.z : low.z);
        const Vec3 p = glm::abs(Vec3(m * Vec4(local, 1)));
        instance.extent = std::max({instance.extent, p.x, p.y, p.z});
    }
}

void EmbreeScene::check_device(const char* what) const {
    const RTCError error = rtcGetDeviceError(device_);
    if (error != RTC_ERROR_NONE)
        throw Error("Embree", std::string(what) + ": " + name_of(error),
                    error == RTC_ERROR_OUT_OF_MEMORY ? "use a smaller scene" : "");
}

}  // namespace chiaro
