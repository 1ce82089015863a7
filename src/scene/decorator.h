// Puts meshes into a scene, by name and place.
#pragma once

#include "scene/scene.h"
#include "scene/shapes.h"

#include <string>
#include <utility>

namespace chiaro {

class Decorator {
public:
    /// Adds to `scene`, which is to outlive it.
    explicit Decorator(Scene& scene) : scene_(scene) {}

    MeshId mesh(std::string name, Mesh mesh) {
        mesh.name = std::move(name);
        scene_.meshes.push_back(std::move(mesh));
        return static_cast<MeshId>(scene_.meshes.size() - 1);
    }
    void place(std::string name, MeshId mesh, const Mat4& to_world = Mat4(1)) {
        scene_.objects.push_back({.name = std::move(name), .mesh = mesh, .to_world = to_world});
    }
    void place(const std::string& name, Mesh one_of_a_kind, const Mat4& to_world = Mat4(1)) {
        place(name, mesh(name, std::move(one_of_a_kind)), to_world);
    }

private:
    Scene& scene_;
};

/// On the floor (or at `y`), turned about its vertical.
inline Mat4 standing(float x, float z, float degrees = 0, float y = 0) {
    return moved({x, y, z}) * turned({0, 1, 0}, degrees);
}

}  // namespace chiaro
