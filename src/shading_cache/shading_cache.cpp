#include "shading_cache/shading_cache.h"

#include "base/error.h"
#include "base/rgb9e5.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace chiaro {
namespace {

// How far a sample point is pulled from its patch's border toward the centre, as a part of the
// patch: on the border itself half the hemisphere may lie in an adjoining wall.
constexpr float kPull = 0.002f;

// Mesh corners are one vertex where their normals are within this of each other. Faces without
// normals of their own are flat, as the file says, and stay apart at any visible crease.
constexpr float kSmoothCosine = 0.9613f;  // 16 degrees
constexpr float kFlatCosine = 0.9998f;    // 1 degree

// Patches longer than this, in units of their width, are halved across.
constexpr float kLong = 1.5f;

}  // namespace

ShadingCache::ShadingCache(const Scene& scene, Channels channels, SplitRule rule)
    : scene_(&scene), rule_(rule), irradiance_channels_(channels.irradiance) {
    const int total = channels.irradiance + channels.glossy;
    check(channels.irradiance >= 1 && channels.glossy >= 0 && total <= 8,
          "ShadingCache: 1 to 8 channels");
    std::uint32_t count = 0;
    for (const Object& object : scene.objects) {
        first_primitive_.push_back(count);
        count += static_cast<std::uint32_t>(scene.mesh_of(object).primitives.size());
    }
    for (const Material& material : scene.materials) {
        const float y = std::clamp(luminance(mean_reflectance(scene, material)), 0.0f, 1.0f);
        reflectances_.push_back(static_cast<std::uint8_t>(std::lround(255 * y)));
    }
    roots_.assign(2 * static_cast<std::size_t>(count), PatchId::none);
    check(roots_.size() <= std::size_t{1} << 29, "ShadingCache: more primitives than ids");
    slots_.resize(total);
    estimates_.resize(total);
    shown_.resize(total);
}

PatchId ShadingCache::root(ObjectId object, std::uint32_t primitive, bool front) {
    const std::uint32_t side =
        2 * (first_primitive_[index_of(object)] + primitive) + (front ? 0 : 1);
    PatchId& id = roots_[side];
    if (id != PatchId::none) return id;
    id = static_cast<PatchId>(patches_.size());

    const Primitive& p = scene_->mesh_of(scene_->objects[index_of(object)]).primitives[primitive];
    Patch patch;
    patch.corners.fill(VertexId::none);
    patch.parent = side;
    patch.reflectance = reflectances_[index_of(p.material)];
    append(patches_, patch);
    const int corners = p.corner_count();
    // add_vertex() reads the patch's kind from its fourth corner.
    if (corners == 4) patches_.back().corners[3] = VertexId{0};
    for (int c = 0; c < corners; ++c)
        patches_.back().corners[c] = corner_vertex(object, primitive, c, side);
    return id;
}

PatchId ShadingCache::subdivide(PatchId leaf) {
    check(patch(leaf).is_leaf(), "subdivide: the patch has children already");
    check(patch(leaf).divisible(), "subdivide: the patch is too small to be divided");
    const Split split = choose_split(leaf);
    const auto first = static_cast<PatchId>(patches_.size());
    std::array<VertexId, kCentre + 1> made;  // vertices by node, each made when first needed
    made.fill(VertexId::none);
    for (int c = 0; c < child_count(split); ++c) {
        Patch child;
        child.corners.fill(VertexId::none);
        const auto nodes = child_corners(split, c);
        for (int i = 0; i < 4; ++i) {
            if (nodes[i] == kNoNode) continue;
            VertexId& vertex = made[nodes[i]];
            if (vertex == VertexId::none) vertex = node_vertex(leaf, nodes[i]);
            child.corners[i] = vertex;
        }
        child.parent = static_cast<std::uint32_t>(leaf);
        child.level = static_cast<std::uint8_t>(patch(leaf).level + 1);
        child.last_seen = patch(leaf).last_seen;
        child.reflectance = patch(leaf).reflectance;
        append(patches_, child);
    }
    patch(leaf).split = split;
    patch(leaf).first_child = first;
    return first;
}

// Four children, or two where the patch is much longer than wide.
Split ShadingCache::choose_split(PatchId leaf) const {
    const bool quad = patch(leaf).is_quad();
    if (rule_ == SplitRule::always_four)
        return quad ? Split::quad_in_four : Split::triangle_in_four;

    const int n = patch(leaf).corner_count();
    const std::uint32_t side = surface_side(leaf);
    std::array<Vec3, 4> p{};
    for (int i = 0; i < n; ++i)
        p[i] = surface_geometry(*scene_, place(side, surface_uv(leaf, node_place(quad, Node(i)))))
                   .position;
    if (quad) {
        const float s = glm::length(p[1] - p[0]) + glm::length(p[2] - p[3]);
        const float t = glm::length(p[3] - p[0]) + glm::length(p[2] - p[1]);
        if (s > kLong * t) return Split::quad_across_s;
        if (t > kLong * s) return Split::quad_across_t;
        return Split::quad_in_four;
    }
    const std::array<float, 3> edges = {glm::length(p[1] - p[0]), glm::length(p[2] - p[1]),
                                        glm::length(p[0] - p[2])};
    const auto longest = std::max_element(edges.begin(), edges.end()) - edges.begin();
    const float area = 0.5f * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    const float height = 2 * area / edges[longest];
    if (edges[longest] > 2 * kLong * height)
        return static_cast<Split>(static_cast<int>(Split::triangle_edge_01) + longest);
    return Split::triangle_in_four;
}

VertexId ShadingCache::node_vertex(PatchId id, Node node) {
    const Patch& p = patch(id);
    if (node < kFirstMidpoint) return p.corners[node];
    if (node == kCentre) return add_vertex(id, node_place(true, kCentre), p.corners);
    return edge_midpoint(id, node);
}

VertexId ShadingCache::edge_midpoint(PatchId id, Node node) {
    const Patch& p = patch(id);
    const int edge = node - kFirstMidpoint;
    const std::array<VertexId, 2> ends = {p.corners[edge],
                                          p.corners[(edge + 1) % p.corner_count()]};
    if (const auto known = midpoint(ends[0], ends[1])) return *known;
    const VertexId made = add_vertex(id, node_place(p.is_quad(), node), ends);
    edges_.insert(made, vertices_);
    return made;
}

// A vertex at a local point of a patch, whose value its parents predict in equal parts until it is
// evaluated.
VertexId ShadingCache::add_vertex(PatchId id, Vec2 local, std::span<const VertexId> parents) {
    const bool quad = patch(id).is_quad();
    const Vec2 centre = quad ? Vec2(0.5f) : Vec2(1.0f / 3);
    CacheVertex vertex;
    vertex.surface_side = surface_side(id) & 0x1fff'ffffU;
    vertex.uv = surface_uv(id, glm::mix(local, centre, kPull));
    for (std::size_t i = 0; i < parents.size(); ++i) {
        vertex.parents[i] = parents[i];
        vertex.weights[i] = static_cast<std::uint8_t>(CacheVertex::kFullWeight / parents.size());
    }
    append(vertices_, vertex);
    const auto made = static_cast<VertexId>(vertices_.size() - 1);
    for (int c = 0; c < channels(); ++c) {
        append(slots_[c], kNoSlot);
        append(shown_[c], std::uint32_t{0});
    }
    resolve_vertex(made);
    return made;
}

// Corners of the mesh are shared across the primitives of an object where place, material, side and
// normal agree.
VertexId ShadingCache::corner_vertex(ObjectId object, std::uint32_t primitive, int corner,
                                     std::uint32_t side) {
    const Mesh& mesh = scene_->mesh_of(scene_->objects[index_of(object)]);
    const Primitive& p = mesh.primitives[primitive];
    const Vec3 position = mesh.positions[p.corners[corner]] + 0.0f;  // -0 becomes 0
    const auto material = static_cast<std::uint32_t>(p.material);
    std::uint64_t key = hash32(static_cast<std::uint32_t>(object), 2 * material + (side & 1));
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(position[i]);
        key = key * 0x9e3779b97f4a7c15ULL + hash32(bits, static_cast<std::uint32_t>(i));
        key ^= key >> 29;
    }

    const auto normal_at = [&](VertexId v) {
        return surface_geometry(*scene_, surface_point(v)).shading_normal;
    };
    const VertexId made_so_far = static_cast<VertexId>(vertices_.size());
    const VertexId candidate = add_vertex(roots_[side], node_place(p.is_quad(), Node(corner)), {});
    const Vec3 normal = normal_at(candidate);
    const float cosine = mesh.normals.empty() ? kFlatCosine : kSmoothCosine;
    const auto [first, last] = welded_.equal_range(key);
    for (auto it = first; it != last; ++it) {
        if (glm::dot(normal_at(it->second), normal) < cosine) continue;
        // The corner is there already: take the candidate back.
        vertices_.pop_back();
        for (int c = 0; c < channels(); ++c) {
            slots_[c].pop_back();
            shown_[c].pop_back();
        }
        return it->second;
    }
    welded_.emplace(key, made_so_far);
    return made_so_far;
}

std::optional<VertexId> ShadingCache::midpoint(VertexId a, VertexId b) const {
    const VertexId found = edges_.find(a, b, vertices_);
    if (found == VertexId::none) return std::nullopt;
    return found;
}

int ShadingCache::child_index(PatchId child) const {
    check(!patch(child).is_root(), "child_index: a root has no siblings");
    const Patch& parent = patches_[patch(child).parent];
    return static_cast<int>(index_of(child) - index_of(parent.first_child));
}

std::uint32_t ShadingCache::surface_side(PatchId id) const {
    while (!patch(id).is_root()) id = static_cast<PatchId>(patch(id).parent);
    return patch(id).parent;
}

Vec2 ShadingCache::surface_uv(PatchId id, Vec2 local) const {
    for (; !patch(id).is_root(); id = static_cast<PatchId>(patch(id).parent))
        local = to_parent(patches_[patch(id).parent].split, child_index(id), local);
    return local;
}

SurfacePoint ShadingCache::place(std::uint32_t surface_side, Vec2 uv) const {
    const std::uint32_t primitive = surface_side / 2;
    const auto next = std::upper_bound(first_primitive_.begin(), first_primitive_.end(), primitive);
    const auto object = static_cast<std::uint32_t>(next - first_primitive_.begin() - 1);
    return {static_cast<ObjectId>(object), primitive - first_primitive_[object], uv.x, uv.y};
}

SurfacePoint ShadingCache::surface_point(VertexId id) const {
    return place(vertex(id).surface_side, vertex(id).uv);
}

const Estimate* ShadingCache::estimate(VertexId vertex, int channel) const {
    const std::uint32_t slot = slots_[channel][index_of(vertex)];
    return slot == kNoSlot ? nullptr : &estimates_[channel][slot];
}

std::size_t ShadingCache::bytes() const {
    const auto held = [](const auto& array) {
        return array.capacity() * sizeof(typename std::decay_t<decltype(array)>::value_type);
    };
    std::size_t total = held(roots_) + held(first_primitive_) + held(patches_) + held(vertices_) +
                        edges_.bytes() +
                        welded_.size() * (sizeof(std::uint64_t) + 4 + 2 * sizeof(void*));
    for (int c = 0; c < channels(); ++c)
        total += held(slots_[c]) + held(estimates_[c]) + held(shown_[c]);
    return total;
}

}  // namespace chiaro
