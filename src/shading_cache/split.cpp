#include "shading_cache/split.h"

#include "base/error.h"

namespace chiaro {
namespace {

struct Family {
    int count;
    std::array<std::array<Node, 4>, 4> corners;
};

constexpr std::array<Node, 4> kUnused = {kNoNode, kNoNode, kNoNode, kNoNode};

constexpr std::array<Family, 8> kFamilies = {{
    {0, {kUnused, kUnused, kUnused, kUnused}},
    {4, {{{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}}},
    {2, {{{0, 4, 6, 3}, {4, 1, 2, 6}, kUnused, kUnused}}},
    {2, {{{0, 1, 5, 7}, {7, 5, 2, 3}, kUnused, kUnused}}},
    {4, {{{0, 4, 6, kNoNode}, {4, 1, 5, kNoNode}, {6, 5, 2, kNoNode}, {5, 6, 4, kNoNode}}}},
    {2, {{{0, 4, 2, kNoNode}, {4, 1, 2, kNoNode}, kUnused, kUnused}}},
    {2, {{{1, 5, 0, kNoNode}, {5, 2, 0, kNoNode}, kUnused, kUnused}}},
    {2, {{{2, 6, 1, kNoNode}, {6, 0, 1, kNoNode}, kUnused, kUnused}}},
}};

const Family& family(Split split) {
    return kFamilies[static_cast<std::size_t>(split)];
}

bool divides_quad(Split split) {
    return split <= Split::quad_across_t;
}

// A child's place in its parent, and the way back.
struct Affine {
    Vec2 origin;
    Vec2 along_s, along_t;      // child to parent
    Vec2 inverse_s, inverse_t;  // rows of the inverse's columns: parent to child
};

Affine make_affine(Split split, int child) {
    const auto& nodes = family(split).corners[child];
    const bool quad = divides_quad(split);
    Affine a;
    a.origin = node_place(quad, nodes[0]);
    a.along_s = node_place(quad, nodes[1]) - a.origin;
    a.along_t = node_place(quad, nodes[quad ? 3 : 2]) - a.origin;
    const float determinant = a.along_s.x * a.along_t.y - a.along_s.y * a.along_t.x;
    a.inverse_s = Vec2(a.along_t.y, -a.along_s.y) / determinant;
    a.inverse_t = Vec2(-a.along_t.x, a.along_s.x) / determinant;
    return a;
}

const std::array<std::array<Affine, 4>, 8> kAffine = [] {
    std::array<std::array<Affine, 4>, 8> table{};
    for (std::size_t s = 1; s < kFamilies.size(); ++s)
        for (int c = 0; c < kFamilies[s].count; ++c)
            table[s][c] = make_affine(static_cast<Split>(s), c);
    return table;
}();

const Affine& affine(Split split, int child) {
    return kAffine[static_cast<std::size_t>(split)][child];
}

}  // namespace

int child_count(Split split) {
    return family(split).count;
}

std::span<const Node, 4> child_corners(Split split, int child) {
    return family(split).corners[child];
}

int child_at(Split split, Vec2 local) {
    const float s = local.x, t = local.y;
    const float r = 1 - s - t;  // weight of a triangle's corner 0
    switch (split) {
        case Split::quad_in_four:
            return t <= 0.5f ? (s <= 0.5f ? 0 : 1) : (s <= 0.5f ? 3 : 2);
        case Split::quad_across_s:
            return s <= 0.5f ? 0 : 1;
        case Split::quad_across_t:
            return t <= 0.5f ? 0 : 1;
        case Split::triangle_in_four:
            return r >= 0.5f ? 0 : s >= 0.5f ? 1 : t >= 0.5f ? 2 : 3;
        case Split::triangle_edge_01:
            return r >= s ? 0 : 1;
        case Split::triangle_edge_12:
            return s >= t ? 0 : 1;
        case Split::triangle_edge_20:
            return t >= r ? 0 : 1;
        case Split::none:
            break;
    }
    check(false, "child_at: a leaf has no children");
    return 0;
}

Vec2 to_child(Split split, int child, Vec2 local) {
    const Affine& a = affine(split, child);
    const Vec2 d = local - a.origin;
    return d.x * a.inverse_s + d.y * a.inverse_t;
}

Vec2 to_parent(Split split, int child, Vec2 local) {
    const Affine& a = affine(split, child);
    return a.origin + local.x * a.along_s + local.y * a.along_t;
}

Vec2 node_place(bool quad, Node node) {
    constexpr std::array<Vec2, 9> on_quad = {Vec2(0, 0),    Vec2(1, 0),    Vec2(1, 1),
                                             Vec2(0, 1),    Vec2(0.5f, 0), Vec2(1, 0.5f),
                                             Vec2(0.5f, 1), Vec2(0, 0.5f), Vec2(0.5f, 0.5f)};
    constexpr std::array<Vec2, 7> on_triangle = {Vec2(0, 0),    Vec2(1, 0),       Vec2(0, 1),
                                                 Vec2(0, 0),  // a triangle has no corner 3
                                                 Vec2(0.5f, 0), Vec2(0.5f, 0.5f), Vec2(0, 0.5f)};
    check(node < (quad ? on_quad.size() : on_triangle.size()), "node_place: no such node");
    return quad ? on_quad[node] : on_triangle[node];
}

Vec2 pulled_in(bool quad, Vec2 local) {
    constexpr float kPull = 0.002f;
    return glm::mix(local, quad ? Vec2(0.5f) : Vec2(1.0f / 3), kPull);
}

}  // namespace chiaro
