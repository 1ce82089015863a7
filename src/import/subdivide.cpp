#include "import/subdivide.h"

#include "base/error.h"
#include "import/fault.h"
#include "import/load_scene.h"
#include "import/patch_colors.h"
#include "import/refine_cage.h"
#include "scene/bicubic_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

namespace chiaro {
namespace {

// Corners of all faces together, faces at a vertex and corners of a face: beyond these OpenSubdiv
// would take more memory and time than a surface is worth.
constexpr std::size_t kMostCorners = 500'000;
constexpr std::uint32_t kMostAtVertex = 1000;
constexpr double kMostSquares = 8e6;

// Cages are refined up to so many levels while patches are no more than these.
constexpr int kMostLevels = 3;
constexpr std::size_t kEnoughPatches = 16'384;

// Leaves out faces that come to a vertex twice; returns how many.
std::size_t drop_degenerate_faces(Cage& cage) {
    Cage kept = cage;
    for (auto* array : {&kept.corner_counts, &kept.corners, &kept.uv_corners, &kept.holes})
        array->clear();
    kept.materials.clear();
    const std::set<std::uint32_t> holes(cage.holes.begin(), cage.holes.end());
    std::size_t first = 0;
    for (std::size_t face = 0; face < cage.corner_counts.size(); ++face) {
        const std::uint32_t count = cage.corner_counts[face];
        const auto copy = [&](const auto& from, auto& to) {
            const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
            if (!from.empty()) to.insert(to.end(), begin, begin + count);
        };
        const std::set<std::uint32_t> different(
            cage.corners.begin() + static_cast<std::ptrdiff_t>(first),
            cage.corners.begin() + static_cast<std::ptrdiff_t>(first + count));
        if (different.size() == count) {
            if (holes.contains(static_cast<std::uint32_t>(face)))
                kept.holes.push_back(static_cast<std::uint32_t>(kept.corner_counts.size()));
            kept.corner_counts.push_back(count);
            kept.materials.push_back(cage.materials[face]);
            copy(cage.corners, kept.corners);
            copy(cage.uv_corners, kept.uv_corners);
        }
        first += count;
    }
    const std::size_t dropped = cage.corner_counts.size() - kept.corner_counts.size();
    cage = std::move(kept);
    return dropped;
}

void check_size(const Cage& cage, const std::string& where) {
    const auto refuse = [&](const std::string& what) {
        throw Error(where, fmt::format("object \"{}\" cannot be subdivided: {}",
                                       printable(cage.name), what));
    };
    if (cage.corners.size() > kMostCorners)
        refuse(fmt::format("its faces have more than {} corners", kMostCorners));
    std::vector<std::uint32_t> faces_at(cage.positions.size(), 0);
    for (const std::uint32_t vertex : cage.corners) ++faces_at[vertex];
    if (std::ranges::any_of(faces_at, [](std::uint32_t n) { return n > kMostAtVertex; }))
        refuse(fmt::format("more than {} faces meet at a vertex", kMostAtVertex));
    double squares = 0;  // what OpenSubdiv's tables grow with
    for (const std::uint32_t n : faces_at) squares += double(n) * n;
    if (squares > kMostSquares) refuse("too many faces meet at its vertices");
    if (std::ranges::any_of(cage.corner_counts, [](std::uint32_t n) { return n > kMostAtVertex; }))
        refuse(fmt::format("a face has more than {} corners", kMostAtVertex));
    for (const Vec3 p : cage.positions)
        if (!within_reach(p)) refuse("it has coordinates beyond 1e9");
}

struct Surface {
    RefinedCage cage;
    std::vector<CagePatch> patches;
};

Surface surface_at(const Cage& cage, int levels, const std::string& where) {
    Surface surface = {refine(cage, levels, where), {}};
    surface.patches = patches_of(surface.cage, where);
    return surface;
}

double size_of(const RefinedCage& cage) {
    Box box;
    for (const CagePoint& point : cage.points) box.add(Vec3(point.place));
    return box.diagonal();
}

BicubicPatch shape_of(const CagePatch& piece) {
    BicubicPatch patch;
    for (int k = 0; k < 16; ++k) patch.points[k] = Vec4(Vec3(piece.points[k].place), 1);
    return patch;
}

// How far the middles of patches and of their edges are above or below the surface, where patches
// of the next level have their limit positions: that of corner k of face f is face 4 f + k there.
double deviation(const Surface& surface, const Surface& finer) {
    constexpr int kCorners[4] = {0, 3, 15, 12};
    double most = 0;
    auto parent = surface.patches.begin();
    for (const CagePatch& child : finer.patches) {
        while (parent != surface.patches.end() && parent->face < child.face / 4) ++parent;
        if (parent == surface.patches.end()) break;
        if (parent->face != child.face / 4 || parent->exact) continue;
        const BicubicPatch patch = shape_of(*parent);
        const int k = static_cast<int>(child.face % 4), next = (k + 1) % 4, opposite = (k + 2) % 4;
        const auto measure = [&](int corner, Vec2 at) {
            const Vec3 limit(child.points[kCorners[corner]].place);
            const Vec3 off = limit - patch_position(patch, at);
            most = std::max<double>(most, std::abs(glm::dot(off, patch_normal(patch, at))));
        };
        measure(next, 0.5f * (patch_corner(k) + patch_corner(next)));
        measure(opposite, Vec2(0.5f));
    }
    return most;
}

// The surface after as few levels as bring it near enough, or as the number of patches allows.
Surface choose_surface(const Cage& cage, const std::string& where) {
    constexpr double kNear = 1.0 / 4000;  // of the size
    const bool quads =
        std::ranges::all_of(cage.corner_counts, [](std::uint32_t n) { return n == 4; });
    int level = quads ? 0 : 1;
    Surface surface = surface_at(cage, level, where);
    for (; level < kMostLevels && 4 * surface.patches.size() <= kEnoughPatches; ++level) {
        const bool exact = std::ranges::all_of(surface.patches, &CagePatch::exact);
        if (exact && !surface.cage.rounded_much) break;
        Surface finer = surface_at(cage, level + 1, where);
        const bool near = deviation(surface, finer) <= kNear * size_of(surface.cage);
        if (level > 0 && near && !surface.cage.rounded_much) break;
        surface = std::move(finer);
    }
    return surface;
}

// Control points that neighbours have in common, as the first of them had them: in exact numbers
// they are equal, rounded they need not be.
class CommonPoints {
public:
    explicit CommonPoints(const RefinedCage& cage)
        : near_(static_cast<float>(1e-5 * size_of(cage))) {}

    void weld(std::span<const std::uint32_t> corners, BicubicPatch& patch) {
        // Places of a corner, and next to it along the patch's boundary both ways.
        constexpr int kPlaces[4][3] = {{0, 1, 4}, {3, 7, 2}, {15, 14, 11}, {12, 8, 13}};
        for (int c = 0; c < 4; ++c) {
            const std::uint32_t here = corners[c];
            const std::uint32_t ends[3] = {here, corners[(c + 1) % 4], corners[(c + 3) % 4]};
            for (int k = 0; k < 3; ++k) {
                Vec4& point = patch.points[kPlaces[c][k]];
                const Vec4& known = known_.try_emplace({here, ends[k]}, point).first->second;
                // Where a surface touches itself it has several limits at one vertex.
                if (glm::distance(Vec3(point), Vec3(known)) <= near_) point = known;
            }
        }
    }

private:
    std::map<std::pair<std::uint32_t, std::uint32_t>, Vec4> known_;  // by vertex and next vertex
    float near_;
};

Mesh make_mesh(const Cage& cage, const Surface& surface) {
    const RefinedCage& refined = surface.cage;
    Mesh mesh;
    mesh.name = cage.name;
    CommonPoints common(refined);
    for (const CagePatch& piece : surface.patches) {
        BicubicPatch patch = shape_of(piece);
        const std::size_t first = std::size_t{4} * piece.face;
        common.weld(std::span(refined.corners).subspan(first, 4), patch);
        CornerUvs uvs = kUnitUvs;
        if (!refined.uvs.empty())
            std::copy_n(refined.uvs.begin() + static_cast<std::ptrdiff_t>(first), 4, uvs.begin());
        add_bicubic(mesh, patch, cage.materials[refined.base_faces[piece.face]], uvs);
        if (cage.colors.empty()) continue;
        const auto color = [&](int point) { return Vec4(piece.points[point].color); };
        color_last_patch(mesh, {color(0), color(3), color(15), color(12)});
    }
    return mesh;
}

}  // namespace

Mesh subdivide(Cage cage, const std::string& where, std::vector<std::string>& warnings) {
    check_size(cage, where);
    const std::size_t dropped = drop_degenerate_faces(cage);
    if (dropped > 0)
        warnings.push_back(
            fmt::format("{}: {} faces that come to a vertex twice were left out", where, dropped));
    if (cage.corner_counts.empty()) return {.name = cage.name};
    return make_mesh(cage, choose_surface(cage, where));
}

void subdivide_meshes(Scene& scene, const std::string& where) {
    for (Mesh& mesh : scene.meshes) {
        if (!mesh.bicubics.empty()) continue;
        if (!mesh.uvs[1].empty())
            scene.warnings.push_back(
                fmt::format("{}: the second texture coordinates of mesh \"{}\" were left out",
                            where, printable(mesh.name)));
        mesh = subdivide(cage_of(mesh), where, scene.warnings);
        order_primitives(mesh);
    }
}

}  // namespace chiaro
