#include "import/obj_cage.h"

#include "import/numbers.h"

#include <utility>

namespace chiaro {
namespace {

// Tags name vertices of the whole file; those of other parts are passed over.
void add_tags(const ObjTags& tags, const std::map<std::uint32_t, std::uint32_t>& vertices,
              Cage& cage) {
    cage.rules = tags.rules;
    for (const SharpEdge& crease : tags.creases) {
        const auto from = vertices.find(crease.from), to = vertices.find(crease.to);
        if (from != vertices.end() && to != vertices.end())
            cage.creases.push_back({from->second, to->second, crease.sharpness});
    }
    for (const SharpVertex& corner : tags.corners)
        if (const auto vertex = vertices.find(corner.vertex); vertex != vertices.end())
            cage.sharp_vertices.push_back({vertex->second, corner.sharpness});
}

}  // namespace

Cage make_cage(const ObjGeometry& geometry, const ObjPart& part, const ObjTags& tags) {
    Cage cage;
    cage.name = part.name;
    Numbers<std::uint32_t> vertices;  // those of the file that the part uses
    // A `vt` that two vertices have is one for each: OpenSubdiv moves them apart.
    Numbers<std::pair<std::uint32_t, std::uint32_t>> uvs;
    bool has_uvs = true;
    for (const ObjFace& face : part.faces) {
        if (tags.holes.contains(face.number))
            cage.holes.push_back(static_cast<std::uint32_t>(cage.corner_counts.size()));
        cage.corner_counts.push_back(face.corner_count);
        cage.materials.push_back(face.material);
        for (std::uint32_t c = 0; c < face.corner_count; ++c) {
            const ObjCorner& corner = geometry.corners[face.first_corner + c];
            cage.corners.push_back(vertices(corner.v));
            cage.uv_corners.push_back(uvs({corner.v, corner.vt}));
            has_uvs &= corner.vt != ObjCorner::kNone;
        }
    }
    for (const std::uint32_t v : vertices.used) {
        cage.positions.push_back(geometry.v[v]);
        if (!geometry.colors.empty()) cage.colors.emplace_back(geometry.colors[v], 1);
    }
    if (has_uvs)
        for (const auto& [v, vt] : uvs.used) cage.uvs.push_back(mesh_uv(geometry.vt[vt]));
    else
        cage.uv_corners.clear();
    add_tags(tags, vertices.of, cage);
    return cage;
}

}  // namespace chiaro
