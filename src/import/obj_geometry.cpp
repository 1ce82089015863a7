#include "import/obj_geometry.h"

#include "base/error.h"
#include "import/directions.h"
#include "import/ear_clip.h"
#include "import/load_scene.h"
#include "import/patch_colors.h"
#include "scene/bicubic_mesh.h"

#include <fmt/format.h>

#include <span>
#include <unordered_map>

namespace chiaro {
namespace {

struct CornerHash {
    std::size_t operator()(const ObjCorner& c) const {
        std::uint64_t h = c.v * 0x9e37'79b9'7f4a'7c15ull;
        h = (h ^ (h >> 29) ^ c.vt) * 0xbf58'476d'1ce4'e5b9ull;
        h = (h ^ (h >> 32) ^ c.vn) * 0x94d0'49bb'1331'11ebull;
        return h ^ (h >> 31);
    }
};
struct CornerEqual {
    bool operator()(const ObjCorner& a, const ObjCorner& b) const {
        return a.v == b.v && a.vt == b.vt && a.vn == b.vn;
    }
};

// One surface of a part.
class SurfaceMaker {
public:
    SurfaceMaker(const ObjGeometry& geometry, const ObjSurface& surface, const std::string& file)
        : geometry_(geometry), surface_(surface), file_(file) {}

    void add_to(Mesh& mesh) const {
        for (std::uint32_t row = 0; row < surface_.shape.rows; ++row)
            for (std::uint32_t column = 0; column < surface_.shape.columns; ++column)
                add_piece(3 * column, 3 * row, mesh);
    }

private:
    // The piece whose first control point is (column, row) of the surface's.
    void add_piece(std::uint32_t column, std::uint32_t row, Mesh& mesh) const {
        BicubicPatch patch;
        for (std::uint32_t j = 0; j < 4; ++j)
            for (std::uint32_t i = 0; i < 4; ++i)
                patch.at(static_cast<int>(i), static_cast<int>(j)) =
                    control_point(corner(column + i, row + j));
        const std::array<ObjCorner, 4> corners = {corner(column, row), corner(column + 3, row),
                                                  corner(column + 3, row + 3),
                                                  corner(column, row + 3)};
        CornerUvs uvs = kUnitUvs;
        for (int c = 0; c < 4; ++c)
            if (corners[c].vt != ObjCorner::kNone) uvs[c] = mesh_uv(geometry_.vt[corners[c].vt]);
        add_bicubic(mesh, patch, surface_.material, uvs);
        if (geometry_.colors.empty()) return;
        std::array<Vec4, 4> colors;
        for (int c = 0; c < 4; ++c) colors[c] = Vec4(geometry_.colors[corners[c].v], 1);
        color_last_patch(mesh, colors);
    }

    const ObjCorner& corner(std::uint32_t column, std::uint32_t row) const {
        const std::size_t width = std::size_t{3} * surface_.shape.columns + 1;
        return geometry_.corners[surface_.shape.first_corner + row * width + column];
    }

    Vec4 control_point(const ObjCorner& corner) const {
        constexpr float kLeast = 0.01f, kMost = 100;
        const Vec3 place = geometry_.v[corner.v];
        const bool weighted = surface_.shape.rational && !geometry_.weights.empty();
        const float weight = weighted ? geometry_.weights[corner.v] : 1;
        if (!within_reach(place)) refuse(corner, "has coordinates beyond 1e9");
        if (!(weight >= kLeast && weight <= kMost))
            refuse(corner,
                   fmt::format("has the weight {}, not one from {} to {}", weight, kLeast, kMost));
        return Vec4(weight * place, weight);
    }

    [[noreturn]] void refuse(const ObjCorner& corner, const std::string& what) const {
        throw Error(fmt::format("{}:{}", file_, surface_.shape.line),
                    fmt::format("control point {} {}", corner.v + 1, what));
    }

    const ObjGeometry& geometry_;
    const ObjSurface& surface_;
    const std::string& file_;
};

class MeshMaker {
public:
    MeshMaker(const ObjGeometry& geometry, const ObjPart& part, const std::string& file)
        : geometry_(geometry) {
        mesh_.name = part.name;
        add_surfaces(geometry, part, file, mesh_);
        has_normals_ = has_uvs_ = !mesh_.bicubics.empty();
        for (const ObjFace& face : part.faces)
            for (const ObjCorner& corner : corners_of(face)) {
                has_normals_ |= has_normal(corner);
                has_uvs_ |= corner.vt != ObjCorner::kNone;
            }
    }

    void add(const ObjFace& face, const std::string& file) {
        const std::span<const ObjCorner> corners = corners_of(face);
        outline_.clear();
        for (const ObjCorner& corner : corners) outline_.push_back(geometry_.v[corner.v]);
        pieces_.clear();
        if (!split_polygon(outline_, pieces_))
            throw Error(fmt::format("{}:{}", file, face.line),
                        fmt::format("a polygon of {} corners that is not convex is too large",
                                    corners.size()),
                        fmt::format("split it into faces of at most {}", kMaxConcaveCorners));

        const Vec3 normal = has_normals_ ? face_normal() : Vec3(0);
        points_.clear();
        for (const ObjCorner& corner : corners) points_.push_back(point(corner, normal));
        for (const PolygonPiece& piece : pieces_) {
            Primitive primitive = {{}, face.material};
            for (std::size_t i = 0; i < 4; ++i)
                primitive.corners[i] =
                    piece[i] == Primitive::kNoCorner ? Primitive::kNoCorner : points_[piece[i]];
            mesh_.primitives.push_back(primitive);
        }
    }

    Mesh take() { return std::move(mesh_); }

private:
    std::span<const ObjCorner> corners_of(const ObjFace& face) const {
        return std::span(geometry_.corners).subspan(face.first_corner, face.corner_count);
    }

    bool has_normal(const ObjCorner& corner) const {
        return corner.vn != ObjCorner::kNone && geometry_.vn[corner.vn] != Vec3(0);
    }

    Vec3 face_normal() const {
        const Vec3 normal = unit_or_zero(vector_area(outline_));
        return normal == Vec3(0) ? Vec3(0, 0, 1) : normal;
    }

    // The mesh's point for a corner. One without a normal, in a mesh that has some, takes that of
    // its face and is no other face's.
    std::uint32_t point(const ObjCorner& corner, Vec3 face_normal) {
        const auto fresh = static_cast<std::uint32_t>(mesh_.positions.size());
        if (!has_normals_ || has_normal(corner)) {
            const auto [known, inserted] = known_.try_emplace(corner, fresh);
            if (!inserted) return known->second;
        }
        mesh_.positions.push_back(geometry_.v[corner.v]);
        if (has_normals_)
            mesh_.normals.push_back(has_normal(corner) ? geometry_.vn[corner.vn] : face_normal);
        if (has_uvs_) {
            const Vec2 uv = corner.vt == ObjCorner::kNone ? Vec2(0) : geometry_.vt[corner.vt];
            mesh_.uvs[0].push_back(mesh_uv(uv));
        }
        if (!geometry_.colors.empty()) mesh_.colors.emplace_back(geometry_.colors[corner.v], 1);
        return fresh;
    }

    const ObjGeometry& geometry_;
    Mesh mesh_;
    bool has_normals_ = false;
    bool has_uvs_ = false;
    std::unordered_map<ObjCorner, std::uint32_t, CornerHash, CornerEqual> known_;
    std::vector<Vec3> outline_;         // of the face at hand
    std::vector<PolygonPiece> pieces_;  // of the face at hand
    std::vector<std::uint32_t> points_;
};

}  // namespace

void add_surfaces(const ObjGeometry& geometry, const ObjPart& part, const std::string& file,
                  Mesh& mesh) {
    for (const ObjSurface& surface : part.surfaces)
        SurfaceMaker(geometry, surface, file).add_to(mesh);
}

Mesh make_mesh(const ObjGeometry& geometry, const ObjPart& part, const std::string& file) {
    MeshMaker maker(geometry, part, file);
    for (const ObjFace& face : part.faces) maker.add(face, file);
    return maker.take();
}

}  // namespace chiaro
