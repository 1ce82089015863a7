// Bicubic patches as Embree sees them: once for all rays, and finer for those from the eye.

#include "rays/embree_scene.h"
#include "rays/ray_caster.h"

#include <cstring>

namespace chiaro {

void EmbreeScene::make_curves(MeshId id, const Scene& scene) {
    const Mesh& mesh = scene.meshes[index_of(id)];
    Box box;
    for (const BicubicPatch& patch : mesh.bicubics) box.add(hull(patch));
    const float tolerance = curve_tolerance_ * box.diagonal();
    curve_tolerances_[index_of(id)] = tolerance;
    grids_[index_of(id)] = tessellate(
        mesh.bicubics, [&](const Box&) { return tolerance; }, threads_);
}

// The points are Embree's afterwards.
void EmbreeScene::attach_curves(RTCScene mesh_scene, PatchGrids& grids, const Mesh& mesh,
                                const Scene& scene) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    void* points = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(Vec3), grids.points.size());
    void* cells = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID,
                                          sizeof(RTCGrid), grids.grids.size());
    check_device("allocating points of curved surfaces");
    std::memcpy(points, grids.points.data(), grids.points.size() * sizeof(Vec3));
    grids.points = {};
    for (std::size_t i = 0; i < grids.grids.size(); ++i) {
        const PatchGrid& grid = grids.grids[i];
        static_cast<RTCGrid*>(cells)[i] = {grid.first, grid.columns + 1U,
                                           static_cast<unsigned short>(grid.columns + 1),
                                           static_cast<unsigned short>(grid.rows + 1)};
    }
    attach(mesh_scene, geometry, mesh, scene, kBicubics);
}

void EmbreeScene::show_curves(const Scene& scene, std::vector<ShownCurves> curves) {
    stop_showing();
    if (curves.empty()) return;
    try {
        build_eye(scene, curves);
    } catch (...) {
        stop_showing();
        throw;
    }
}

void EmbreeScene::build_eye(const Scene& scene, std::vector<ShownCurves>& curves) {
    arena_.execute([&] {
        for (ShownCurves& some : curves) show(scene, some);

        // All else is as other rays see it.
        eye_ = new_scene();
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            const Shown* shown = shown_of(static_cast<std::uint32_t>(i));
            const RTCGeometry geometry = shown != nullptr ? shown->instance : objects_[i].geometry;
            if (geometry != nullptr)
                rtcAttachGeometryByID(eye_, geometry, static_cast<unsigned>(i));
        }
        rtcCommitScene(eye_);
    });
    check_device("building what the eye sees");
}

void EmbreeScene::show(const Scene& scene, ShownCurves& curves) {
    const Object& object = scene.objects[index_of(curves.object)];
    const Mesh& mesh = scene.mesh_of(object);
    Shown& shown = shown_.emplace_back(Shown{.object = curves.object});
    shown.mesh = new_scene();
    const RTCScene as_before = meshes_[index_of(object.mesh)];
    if (mesh.bicubics.size() < mesh.quad_count)
        rtcAttachGeometryByID(shown.mesh, rtcGetGeometry(as_before, kQuads), kQuads);
    if (mesh.quad_count < mesh.primitives.size())
        rtcAttachGeometryByID(shown.mesh, rtcGetGeometry(as_before, kTriangles), kTriangles);
    attach_curves(shown.mesh, curves.grids, mesh, scene);
    rtcCommitScene(shown.mesh);

    shown.grids = std::move(curves.grids);
    shown.instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(shown.instance, shown.mesh);
    set_matrix(shown.instance, object.to_world);
    if (!object.shown) rtcDisableGeometry(shown.instance);
}

void EmbreeScene::stop_showing() {
    if (eye_ != nullptr) rtcReleaseScene(eye_);
    eye_ = nullptr;
    for (const Shown& shown : shown_) {
        if (shown.instance != nullptr) rtcReleaseGeometry(shown.instance);
        if (shown.mesh != nullptr) rtcReleaseScene(shown.mesh);
    }
    shown_.clear();
}

const EmbreeScene::Shown* EmbreeScene::shown_of(std::uint32_t object) const {
    for (const Shown& shown : shown_)
        if (index_of(shown.object) == object) return &shown;
    return nullptr;
}

std::array<float, 2> EmbreeScene::place_in_cell(const RawHit& hit, bool from_eye) const {
    if (hit.geometry != kBicubics) return {hit.u, hit.v};
    const Shown* shown = from_eye ? shown_of(hit.object) : nullptr;
    const PatchGrids& grids = shown != nullptr ? shown->grids : grids_[objects_[hit.object].mesh];
    const PatchGrid& grid = grids.grids[hit.primitive];
    const float u = hit.u * grid.columns, v = hit.v * grid.rows;
    return {u - std::floor(u), v - std::floor(v)};
}

}  // namespace chiaro
