// Embree's objects for one scene, made and released; only the files of this folder include this.
#pragma once

#include "scene/scene.h"

#include <embree3/rtcore.h>
#include <tbb/task_arena.h>

#include <memory>
#include <vector>

namespace chiaro {

/// What filter functions need to know of the geometry that they are called for.
struct FilterData {
    const Scene* scene;
    std::uint32_t first_primitive;  // of the geometry, in its mesh
};

/// A device, one scene a mesh and one instance an object. The geometry that holds a mesh's quads
/// has id 0, its triangles 1; the instance of an object has the object's index.
class EmbreeScene {
public:
    EmbreeScene(const Scene& scene, int threads);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCScene top() const { return top_; }

    /// First primitive of geometry `geometry` in the mesh of `object`.
    std::uint32_t first_primitive(std::uint32_t object, std::uint32_t geometry) const {
        return geometry == 0 ? 0 : objects_[object].quad_count;
    }
    /// From Embree's normals, in object space and not of unit length, to the front in world space.
    const Mat3& normal_to_world(std::uint32_t object) const {
        return objects_[object].normal_matrix;
    }
    /// Largest coordinate in world space of the object's corners, at least its box.
    float extent(std::uint32_t object) const { return objects_[object].extent; }

    void set_transform(const Scene& scene, ObjectId object);

private:
    struct Instance {
        RTCGeometry geometry = nullptr;  // null: the object shows nothing
        Mat3 normal_matrix = Mat3(1);
        std::uint32_t quad_count = 0;
        float extent = 0;
    };
    void build(const Scene& scene);
    void build_mesh(MeshId mesh, const Scene& scene);
    void release();
    void attach(RTCScene mesh_scene, RTCBuffer positions, const Mesh& mesh, const Scene& scene,
                bool quads);
    void place(const Scene& scene, std::size_t object);
    void check_device(const char* what) const;

    // Builds run in here. Embree's own `threads` would limit every other loop of the program too.
    tbb::task_arena arena_;
    RTCDevice device_ = nullptr;
    RTCScene top_ = nullptr;
    std::vector<RTCScene> meshes_;
    std::vector<Instance> objects_;
    std::vector<std::unique_ptr<FilterData>> filter_data_;  // Embree holds their addresses
};

}  // namespace chiaro
