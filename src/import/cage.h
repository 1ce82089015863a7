// Control cages of Catmull-Clark surfaces.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace chiaro {

/// What happens at the boundary of a cage, by the numbers that files use.
enum class BoundaryRule : std::uint32_t {
    none,             // faces at the boundary only shape those inside
    edge_and_corner,  // the surface ends in the cage's edges, smoothed, and in its corners
    edge_only,        // corners are smoothed too
};

/// The same of texture coordinates at the edges of their maps.
enum class UvRule : std::uint32_t {
    linear,           // not smoothed anywhere
    edge_and_corner,  // edges smoothed, corners kept
    edge_only,
    always_sharp,  // smoothed inside alone
};

struct SubdivisionRules {
    BoundaryRule boundary = BoundaryRule::edge_and_corner;
    UvRule uvs = UvRule::edge_and_corner;
    bool chaikin = false;  // sharpness along a crease is smoothed
};

/// Sharpness: how many levels of subdivision are sharp; this many and more, all of them
/// (OpenSubdiv's Sdc::Crease::SHARPNESS_INFINITE).
inline constexpr float kInfinitelySharp = 10;
struct SharpEdge {
    std::uint32_t from, to;
    float sharpness;
};
struct SharpVertex {
    std::uint32_t vertex;
    float sharpness;
};

struct Cage {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec4> colors;  // empty, or one a position
    std::vector<Vec2> uvs;     // as a mesh has them; empty, or named by `uv_corners`

    std::vector<std::uint32_t> corner_counts;  // of each face
    std::vector<std::uint32_t> corners;        // of all faces, in `positions`
    std::vector<std::uint32_t> uv_corners;     // likewise in `uvs`; empty without them
    std::vector<MaterialId> materials;         // of each face

    std::vector<SharpEdge> creases;
    std::vector<SharpVertex> sharp_vertices;
    std::vector<std::uint32_t> holes;  // faces without a surface
    SubdivisionRules rules;
};

/// The cage of a mesh's quads and triangles. Points in one place are one vertex, whatever their
/// normals and texture coordinates.
Cage cage_of(const Mesh& mesh);

}  // namespace chiaro
