// Embree's objects for one scene, made and released; only the files of this folder include this.
#pragma once

#include "scene/surface.h"
#include "scene/tessellate.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace chiaro {

struct ShownCurves;

/// True if rays may pass any of the mesh's surfaces.
bool any_see_through(const Mesh& mesh, const Scene& scene);
/// True if the camera looks through any of the scene's materials from behind.
bool has_single_sided(const Scene& scene);

/// A hit as Embree tells it.
struct RawHit {
    std::uint32_t object;
    std::uint32_t geometry;   // of the object's mesh: see GeometryKind
    std::uint32_t primitive;  // of the geometry
    float u, v, t;
    Vec3 normal;  // object space, not of unit length

    bool is_triangle() const { return geometry == 1; }
};

/// Ids of the geometries of a mesh.
enum GeometryKind : std::uint32_t { kQuads = 0, kTriangles = 1, kBicubics = 2 };

/// A device, one scene a mesh and one instance an object, whose index the instance has. Bicubic
/// patches are grids of triangles, made once, within a tolerance of their mesh's size.
class EmbreeScene {
public:
    EmbreeScene(const Scene& scene, int threads, float curve_tolerance);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene top() const { return top_; }
    /// What rays from the camera meet.
    RTCScene eye() const { return eye_ != nullptr ? eye_ : top_; }

    SurfacePoint point_of(const RawHit& hit) const {
        const std::uint32_t first = objects_[hit.object].first_of[hit.geometry];
        return {static_cast<ObjectId>(hit.object), first + hit.primitive,
                std::clamp(hit.u, 0.0f, 1.0f), std::clamp(hit.v, 0.0f, 1.0f)};
    }
    /// Of the front side; unit, world space.
    Vec3 normal_of(const RawHit& hit) const {
        return safe_normalize(objects_[hit.object].normal_matrix * hit.normal, Vec3(0, 0, 1));
    }
    /// Largest coordinate in world space of the object's corners, at least its box.
    float extent(std::uint32_t object) const { return objects_[object].extent; }
    /// What an object is to Embree.
    struct Instance {
        RTCGeometry geometry = nullptr;  // null: the object shows nothing
        Mat3 normal_matrix = Mat3(1);
        std::size_t mesh = 0;
        const Primitive* primitives = nullptr;       // of the mesh
        std::array<std::uint32_t, 3> first_of = {};  // primitive, by GeometryKind
        float extent = 0;
        float curve_error = 0;  // how far bicubic patches' triangles may be off them, world space
        bool any_curved = false;
    };
    const Instance& instance(std::uint32_t object) const { return objects_[object]; }
    /// Of a hit within the quad, or the triangle, that holds it: cells of bicubic patches are
    /// quads.
    std::array<float, 2> place_in_cell(const RawHit& hit, bool from_eye) const;
    float curve_error(std::uint32_t object) const { return objects_[object].curve_error; }
    /// True if the primitive's normals are its geometric one everywhere, or absent.
    bool flat(const Instance& of, std::uint32_t primitive) const {
        return !of.any_curved || !curved_[of.mesh][primitive];
    }
    /// True if the camera looks through any surface from behind.
    bool any_single_sided() const { return any_single_sided_; }
    /// True if any surface may let rays pass.
    bool any_filter() const { return any_filter_; }

    void set_transform(const Scene& scene, ObjectId object);
    void set_shown(const Scene& scene, ObjectId object);
    void add_objects(const Scene& scene);
    void set_material(const Scene& scene, MaterialId material);
    /// See RayCaster.
    void show_curves(const Scene& scene, std::vector<ShownCurves> curves);
    float curve_tolerance(MeshId mesh) const { return curve_tolerances_[index_of(mesh)]; }

private:
    void build(const Scene& scene);
    void add_instances(const Scene& scene);
    void add_instance(const Scene& scene, std::size_t object);
    void follow_sides(const Scene& scene);
    void follow_filter(const Scene& scene, MeshId mesh);
    void commit(const char* what);
    RTCScene new_scene() const;
    RTCSceneFlags scene_flags() const;
    void build_mesh(MeshId mesh, const Scene& scene);
    void release();
    void attach_polygons(RTCScene mesh_scene, RTCBuffer positions, const Mesh& mesh,
                         const Scene& scene, GeometryKind kind);
    void make_curves(MeshId mesh, const Scene& scene);
    void attach_curves(RTCScene mesh_scene, PatchGrids& grids, const Mesh& mesh,
                       const Scene& scene);
    void attach(RTCScene mesh_scene, RTCGeometry geometry, const Mesh& mesh, const Scene& scene,
                GeometryKind kind);
    void set_filter(RTCGeometry geometry, bool see_through);
    void place(const Scene& scene, std::size_t object);
    static void set_matrix(RTCGeometry instance, const Mat4& to_world);

    // An object as the eye sees it.
    struct Shown {
        ObjectId object = ObjectId::none;
        RTCScene mesh = nullptr;
        RTCGeometry instance = nullptr;
        PatchGrids grids = {};
    };
    void build_eye(const Scene& scene, std::vector<ShownCurves>& curves);
    void show(const Scene& scene, ShownCurves& curves);
    void stop_showing();
    const Shown* shown_of(std::uint32_t object) const;
    void check_device(const char* what) const;

    // Builds run in here. Embree's own `threads` would limit every other loop of the program too.
    tbb::task_arena arena_;
    int threads_;
    RTCDevice device_ = nullptr;
    RTCScene top_ = nullptr;
    RTCScene eye_ = nullptr;  // null: the same
    std::vector<Shown> shown_;
    std::vector<RTCScene> meshes_;
    std::vector<PatchGrids> grids_;          // by mesh
    float curve_tolerance_;                  // of a mesh's size
    std::vector<float> curve_tolerances_;    // by mesh, object space
    std::vector<std::vector<bool>> curved_;  // by mesh, by primitive; empty: all are flat
    std::vector<Instance> objects_;
    bool any_single_sided_ = false;
    bool any_filter_ = false;
};

}  // namespace chiaro
