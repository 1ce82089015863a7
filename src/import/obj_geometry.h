// The polygons and surfaces of an OBJ file as they were read, and the meshes made of them.
#pragma once

#include "import/obj_free_form.h"
#include "scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace chiaro {

/// Positions in the file's lists of v, vt and vn, from 0; kNone where the corner names none.
struct ObjCorner {
    static constexpr std::uint32_t kNone = 0xffff'ffff;
    std::uint32_t v = kNone;
    std::uint32_t vt = kNone;
    std::uint32_t vn = kNone;
};

struct ObjFace {
    std::uint32_t first_corner;  // in ObjGeometry::corners
    std::uint32_t corner_count;  // at least 3
    MaterialId material;
    std::uint32_t line;
    std::uint32_t number;  // in the file, from 0
};

struct ObjSurface {
    FreeFormSurface shape;
    MaterialId material;
};

/// The faces and surfaces between changes of `o` and `g`, joined where a name comes again.
struct ObjPart {
    std::string name;
    std::vector<ObjFace> faces;
    std::vector<ObjSurface> surfaces;
};

struct ObjGeometry {
    std::vector<Vec3> v;
    std::vector<Vec3> colors;    // empty, or one for each v; white where the line gives none
    std::vector<float> weights;  // of rational surfaces; empty, or one for each v
    std::vector<Vec2> vt;        // v still upwards
    std::vector<Vec3> vn;
    std::vector<ObjCorner> corners;
    std::vector<ObjPart> parts;
};

/// A texture coordinate as meshes have it, with v downwards.
inline Vec2 mesh_uv(Vec2 vt) {
    return {vt.x, 1 - vt.y};
}

/// Adds the surfaces of a part to a mesh that holds no polygons, as bicubic patches. Throws an
/// Error at `file:line` where a control point or a weight is out of bounds.
void add_surfaces(const ObjGeometry& geometry, const ObjPart& part, const std::string& file,
                  Mesh& mesh);

/// The mesh of one part: its surfaces, then one point for each different (v, vt, vn) of its faces.
/// `file` names the file in the Error that a polygon too large to split throws. Checks: all corners
/// are in range.
Mesh make_mesh(const ObjGeometry& geometry, const ObjPart& part, const std::string& file);

}  // namespace chiaro
