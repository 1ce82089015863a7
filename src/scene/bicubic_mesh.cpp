#include "scene/bicubic_mesh.h"

#include "base/error.h"

#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace chiaro {
namespace {

// A patch with all that the mesh knows of it, on its own.
struct LoosePatch {
    BicubicPatch shape;
    MaterialId material;
    CornerUvs uvs[2];
    std::array<Vec4, 4> colors;
};

LoosePatch take(const Mesh& mesh, std::size_t index) {
    const Primitive& primitive = mesh.primitives[index];
    LoosePatch loose = {mesh.bicubics[index], primitive.material, {kUnitUvs, kUnitUvs}, {}};
    for (int c = 0; c < 4; ++c) {
        for (int set = 0; set < 2; ++set)
            if (!mesh.uvs[set].empty()) loose.uvs[set][c] = mesh.uvs[set][primitive.corners[c]];
        if (!mesh.colors.empty()) loose.colors[c] = mesh.colors[primitive.corners[c]];
    }
    return loose;
}

// Of values at four corners, those of the halves, as the patch is halved.
template <typename T>
std::array<std::array<T, 4>, 2> halved(const std::array<T, 4>& v, bool in_u) {
    const auto mean = [](const T& a, const T& b) { return 0.5f * (a + b); };
    if (in_u) {
        const T low = mean(v[0], v[1]), high = mean(v[3], v[2]);
        return {{{v[0], low, high, v[3]}, {low, v[1], v[2], high}}};
    }
    const T low = mean(v[0], v[3]), high = mean(v[1], v[2]);
    return {{{v[0], v[1], high, low}, {low, high, v[2], v[3]}}};
}

std::array<LoosePatch, 2> halved(const LoosePatch& patch, bool in_u) {
    std::array<LoosePatch, 2> parts = {patch, patch};
    const auto shapes = in_u ? halves_in_u(patch.shape) : halves_in_v(patch.shape);
    const auto colors = halved(patch.colors, in_u);
    for (int half = 0; half < 2; ++half) {
        parts[half].shape = shapes[half];
        parts[half].colors = colors[half];
        for (int set = 0; set < 2; ++set) parts[half].uvs[set] = halved(patch.uvs[set], in_u)[half];
    }
    return parts;
}

bool has_area(const BicubicPatch& patch) {
    const float size = hull(patch).diagonal();
    float most = 0;
    for (int k = 0; k < 16; ++k) {
        const PatchPoint p = patch_point(patch, (Vec2(k % 4, k / 4) + 0.5f) / 4.0f);
        most = std::max(most, glm::length(glm::cross(p.du, p.dv)));
    }
    return most > std::max(1e-7f * size * size, 1e-18f);
}

using Place = std::tuple<float, float, float>;
Place place_of(Vec3 p) {
    return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};  // -0 becomes 0
}

// The edges of all patches; those that are the same curve are one.
class Edges {
public:
    static constexpr int kCollapsed = -1;
    // Curves between two places; more are each taken for another one.
    static constexpr std::size_t kMostCompared = 64;

    explicit Edges(std::span<const LoosePatch> patches) {
        for (const LoosePatch& patch : patches) {
            std::array<int, 4> of_patch;
            const float size = hull(patch.shape).diagonal();
            for (int side = 0; side < 4; ++side)
                of_patch[side] = add(patch_edge(patch.shape, side), size);
            of_patches_.push_back(of_patch);
        }
    }

    // Edges that are to be divided, and with them all across the patches beside them.
    std::vector<bool> to_divide() const {
        std::vector<std::vector<int>> across(ambiguous_.size());
        for (const auto& edges : of_patches_)
            for (int side = 0; side < 4; ++side) {
                const int here = edges[side], there = edges[(side + 2) % 4];
                if (here != kCollapsed && there != kCollapsed) across[here].push_back(there);
            }
        std::vector<bool> divided = ambiguous_;
        std::vector<int> waiting;
        for (std::size_t edge = 0; edge < divided.size(); ++edge)
            if (divided[edge]) waiting.push_back(static_cast<int>(edge));
        while (!waiting.empty()) {
            const int edge = waiting.back();
            waiting.pop_back();
            for (const int other : across[edge]) {
                if (divided[other]) continue;
                divided[other] = true;
                waiting.push_back(other);
            }
        }
        return divided;
    }
    const std::array<int, 4>& of_patch(std::size_t patch) const { return of_patches_[patch]; }

private:
    struct Known {
        Vec3 middle;
        int number;
    };

    // The control points of a pole that was moved differ by their rounding.
    int add(const CubicCurve& curve, float patch_size) {
        constexpr float kRounding = 1e-5f;
        const float size = hull(curve).diagonal();
        if (!(size > kRounding * patch_size)) return kCollapsed;
        const Vec3 from = curve_position(curve, 0), to = curve_position(curve, 1);
        const Vec3 middle = curve_position(curve, 0.5f);
        // A small curve far from the origin is rounded by more than it is bent.
        const float near = 1e-3f * size + 1e-6f * max_component(glm::abs(middle));
        const auto key = std::minmax({place_of(from), place_of(to)});
        std::vector<Known>& between = by_ends_[{key.first, key.second}];
        for (const Known& known : std::span(between).first(std::min(between.size(), kMostCompared)))
            if (glm::distance(known.middle, middle) <= near) return known.number;

        const int number = static_cast<int>(ambiguous_.size());
        ambiguous_.push_back(from == to || !between.empty());
        if (!between.empty()) ambiguous_[between.front().number] = true;
        between.push_back({middle, number});
        return number;
    }

    std::map<std::pair<Place, Place>, std::vector<Known>> by_ends_;
    std::vector<bool> ambiguous_;
    std::vector<std::array<int, 4>> of_patches_;
};

// One round: returns whether anything was divided.
bool divide_once(std::vector<LoosePatch>& patches) {
    const Edges edges(patches);
    const std::vector<bool> divided = edges.to_divide();
    const auto wanted = [&](std::size_t patch, int side) {
        const int edge = edges.of_patch(patch)[side];
        return edge != Edges::kCollapsed && divided[edge];
    };
    std::vector<LoosePatch> result;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        std::vector<LoosePatch> parts = {patches[i]};
        for (const bool in_u : {true, false}) {
            if (!wanted(i, in_u ? 0 : 1) && !wanted(i, in_u ? 2 : 3)) continue;
            std::vector<LoosePatch> smaller;
            for (const LoosePatch& part : parts)
                for (const LoosePatch& half : halved(part, in_u)) smaller.push_back(half);
            parts = std::move(smaller);
        }
        result.insert(result.end(), parts.begin(), parts.end());
    }
    const bool any = result.size() != patches.size();
    patches = std::move(result);
    return any;
}

void push_corner(Mesh& mesh, const LoosePatch& patch, int corner) {
    const bool first = mesh.positions.empty();
    const auto grows = [&](const auto& array) { return first || !array.empty(); };
    if (grows(mesh.normals))
        mesh.normals.push_back(patch_normal(patch.shape, patch_corner(corner)));
    if (grows(mesh.uvs[0])) mesh.uvs[0].push_back(patch.uvs[0][corner]);
    if (!mesh.uvs[1].empty()) mesh.uvs[1].push_back(patch.uvs[1][corner]);
    if (!mesh.colors.empty()) mesh.colors.push_back(patch.colors[corner]);
    mesh.positions.push_back(patch_position(patch.shape, patch_corner(corner)));
}

Primitive push_corners(Mesh& mesh, const LoosePatch& patch) {
    Primitive primitive = {.corners = {}, .material = patch.material};
    for (int c = 0; c < 4; ++c) {
        primitive.corners[c] = static_cast<std::uint32_t>(mesh.positions.size());
        push_corner(mesh, patch, c);
    }
    return primitive;
}

}  // namespace

void add_bicubic(Mesh& mesh, const BicubicPatch& patch, MaterialId material, const CornerUvs& uvs) {
    LoosePatch loose = {patch, material, {uvs, uvs}, {}};
    loose.colors.fill(Vec4(1));
    const Primitive primitive = push_corners(mesh, loose);
    mesh.primitives.insert(
        mesh.primitives.begin() + static_cast<std::ptrdiff_t>(mesh.bicubics.size()), primitive);
    mesh.bicubics.push_back(patch);
    ++mesh.quad_count;
}

std::size_t settle_bicubics(Mesh& mesh) {
    const std::size_t before = mesh.bicubics.size();
    if (before == 0) return 0;
    std::vector<LoosePatch> patches;
    for (std::size_t i = 0; i < before; ++i)
        if (has_area(mesh.bicubics[i])) patches.push_back(take(mesh, i));
    const std::size_t dropped = before - patches.size();

    constexpr int kMostRounds = 4;
    bool any = dropped > 0;
    for (int round = 0; round < kMostRounds && divide_once(patches); ++round) any = true;
    if (!any) return dropped;

    std::vector<Primitive> primitives;
    mesh.bicubics.clear();
    for (const LoosePatch& patch : patches) {
        primitives.push_back(push_corners(mesh, patch));
        mesh.bicubics.push_back(patch.shape);
    }
    primitives.insert(primitives.end(),
                      mesh.primitives.begin() + static_cast<std::ptrdiff_t>(before),
                      mesh.primitives.end());
    mesh.primitives = std::move(primitives);
    return dropped;
}

}  // namespace chiaro
