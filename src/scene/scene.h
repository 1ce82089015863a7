// What is rendered: arrays of values that name each other by index, and no behaviour of renderers.
#pragma once

#include "base/ids.h"
#include "base/vec.h"
#include "scene/animation.h"
#include "scene/bicubic.h"
#include "scene/camera.h"
#include "scene/environment.h"
#include "scene/light.h"
#include "scene/material.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace chiaro {

/// A quadrilateral, a triangle or a bicubic patch of a mesh. A quad is the surface of Embree's map:
/// the triangles (0, 1, 3) and (2, 3, 1), met along the diagonal 1-3 (scene/surface.h). A bicubic
/// patch is a quad by its corners alone, which stand at (u, v) = (0, 0), (1, 0), (1, 1), (0, 1);
/// some of them may be in one place (poles).
struct Primitive {
    static constexpr std::uint32_t kNoCorner = 0xffff'ffff;
    std::array<std::uint32_t, 4> corners;  // points of the mesh, counter-clockwise from the front
    MaterialId material;                   // corners[3] is kNoCorner on a triangle

    bool is_quad() const { return corners[3] != kNoCorner; }
    int corner_count() const { return is_quad() ? 4 : 3; }
};

/// Geometry in object space, shared by the objects that show it. Optional arrays are empty or have
/// one entry a point. In `primitives` come first those of the bicubic patches, each at its place in
/// `bicubics`, then quads, both in `quad_count`, then triangles.
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  // unit; absent: each primitive is flat
    std::array<std::vector<Vec2>, 2> uvs;
    std::vector<Vec4> colors;  // linear RGBA that multiplies the base colour
    std::vector<Primitive> primitives;
    std::uint32_t quad_count = 0;
    std::vector<BicubicPatch> bicubics;
};

/// A mesh put in its place in the world. What an edit moves, and what a name in an edit names.
struct Object {
    std::string name;
    MeshId mesh = MeshId::none;
    Mat4 to_world = Mat4(1);      // affine, finite, not singular
    bool shown = true;            // false: it is as if it were not there, but keeps its id
    Rgb emission_scale = Rgb(1);  // multiplies what its surfaces emit; finite, not negative
};

/// Primitives of all objects together, each counted where it is shown.
inline constexpr std::size_t kMostPrimitives = std::size_t{1} << 27;

struct Scene {
    std::vector<Mesh> meshes;
    std::vector<Object> objects;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<PunctualLight> lights;
    std::vector<Camera> cameras;
    std::vector<SceneNode> nodes;   // the file's hierarchy, parents first; may be empty
    Mat4 nodes_to_world = Mat4(1);  // where nodes without parent stand
    std::vector<Animation> animations;
    Environment environment;
    Vec3 up = Vec3(0, 1, 0);  // the world's vertical: of cameras that we choose, of the environment
    std::vector<std::string> warnings;  // what the importer met and went on from, a line each

    const Mesh& mesh_of(const Object& object) const { return meshes[index_of(object.mesh)]; }
    const Material& material(MaterialId id) const { return materials[index_of(id)]; }
    const Texture& texture(TextureId id) const { return textures[index_of(id)]; }
};

/// Bounds in world space of all objects that are shown.
Box bounds(const Scene& scene);

/// Bounds of a mesh put in a place; of bicubic patches, those of their control points.
Box bounds(const Mesh& mesh, const Mat4& to_world);

/// True if the object is shown and one of its primitives emits, be it by its texture alone.
bool emits(const Scene& scene, const Object& object);

/// True if anything emits: a punctual light, an object, the environment.
bool has_light(const Scene& scene);

/// Makes primitives ready for use: bicubic patches, which must come first, divided where edges
/// could be confused (settle_bicubics), then quads, then triangles (stable within the kinds),
/// `quad_count` set, degenerate primitives (no area, repeated corners) dropped; a quad with two
/// corners in one place becomes a triangle. Returns how many were dropped.
std::size_t order_primitives(Mesh& mesh);

/// Ends the program if an index or size of the scene is wrong: importers and built-in scenes
/// promise all that scene.h says.
void check_scene(const Scene& scene);

/// The same of one thing, which need not stand in the scene yet.
void check_mesh(const Scene& scene, const Mesh& mesh);
void check_object(const Scene& scene, const Object& object);
void check_material(const Scene& scene, const Material& material);
void check_light(const PunctualLight& light);
void check_camera(const Camera& camera);

}  // namespace chiaro
