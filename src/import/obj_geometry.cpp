#include "import/obj_geometry.h"

#include "base/error.h"
#include "import/directions.h"
#include "import/ear_clip.h"

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

class MeshMaker {
public:
    MeshMaker(const ObjGeometry& geometry, const ObjPart& part) : geometry_(geometry) {
        mesh_.name = part.name;
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
            mesh_.uvs[0].emplace_back(uv.x, 1 - uv.y);
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

Mesh make_mesh(const ObjGeometry& geometry, const ObjPart& part, const std::string& file) {
    MeshMaker maker(geometry, part);
    for (const ObjFace& face : part.faces) maker.add(face, file);
    return maker.take();
}

}  // namespace chiaro
