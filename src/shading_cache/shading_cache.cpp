#include "shading_cache/shading_cache.h"

#include "base/error.h"
#include "base/rgb9e5.h"
#include "shading_cache/arrays.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

// Patches longer than this, in units of their width, are halved across.
constexpr float kLong = 1.5f;

}  // namespace

ShadingCache::ShadingCache(const Scene& scene, const MeshGraphs& graphs, Channels channels,
                           SplitRule rule)
    : scene_(&scene), graphs_(&graphs), rule_(rule), irradiance_channels_(channels.irradiance) {
    const int total = channels.irradiance + channels.glossy;
    check(channels.irradiance >= 1 && channels.glossy >= 0 && total <= 8,
          "ShadingCache: 1 to 8 channels");
    for (int c = 0; c < total; ++c)
        shown_.emplace_back(c < channels.irradiance ? ShownValues::Layout::dense
                                                    : ShownValues::Layout::sparse);
    follow_scene({});
}

void ShadingCache::follow_scene(std::span<const MaterialId> repainted) {
    std::size_t primitives = roots_.size() / 2, vertices = mesh_vertices_.size() / 2;
    for (std::size_t i = first_primitive_.size(); i < scene_->objects.size(); ++i) {
        const Object& object = scene_->objects[i];
        first_primitive_.push_back(static_cast<std::uint32_t>(primitives));
        first_mesh_vertex_.push_back(static_cast<std::uint32_t>(vertices));
        primitives += scene_->mesh_of(object).primitives.size();
        vertices += graphs_->of(object.mesh).vertex_count();
    }
    check(primitives <= kMostPrimitives, "ShadingCache: more primitives than ids");
    roots_.resize(2 * primitives, PatchId::none);
    mesh_vertices_.resize(2 * vertices, VertexId::none);

    // Means over textures take their time.
    const auto reflectance = [&](const Material& material) {
        const float y = std::clamp(luminance(mean_reflectance(*scene_, material)), 0.0f, 1.0f);
        return static_cast<std::uint8_t>(std::lround(255 * y));
    };
    for (const MaterialId id : repainted)
        if (index_of(id) < reflectances_.size())
            reflectances_[index_of(id)] = reflectance(scene_->material(id));
    for (std::size_t i = reflectances_.size(); i < scene_->materials.size(); ++i)
        reflectances_.push_back(reflectance(scene_->materials[i]));
    if (repainted.empty()) return;

    for (std::size_t side = 0; side < roots_.size(); ++side)
        if (roots_[side] != PatchId::none) {
            const SurfacePoint at = place(static_cast<std::uint32_t>(side), Vec2(0));
            patch(roots_[side]).reflectance = reflectances_[index_of(material_of(*scene_, at))];
        }
    for (Patch& p : patches_)  // parents come before children
        if (!p.is_root()) p.reflectance = patches_[p.parent].reflectance;
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
    if (node == kCentre) {
        CacheVertex vertex = new_vertex(id, node_place(true, kCentre));
        vertex.ends[0] = static_cast<VertexId>(id);
        return add_vertex(vertex);
    }
    return edge_midpoint(id, node);
}

VertexId ShadingCache::edge_midpoint(PatchId id, Node node) {
    const Patch& p = patch(id);
    const int edge = node - kFirstMidpoint;
    const std::array<VertexId, 2> ends = {p.corners[edge],
                                          p.corners[(edge + 1) % p.corner_count()]};
    if (const auto known = midpoint(ends[0], ends[1])) return *known;
    CacheVertex vertex = new_vertex(id, node_place(p.is_quad(), node));
    vertex.ends = ends;
    const VertexId made = add_vertex(vertex);
    edges_.insert(made, vertices_);
    return made;
}

// A vertex at a local point of a patch, without parents.
CacheVertex ShadingCache::new_vertex(PatchId id, Vec2 local) const {
    CacheVertex vertex;
    vertex.set_surface_side(surface_side(id));
    vertex.uv = surface_uv(id, pulled_in(patch(id).is_quad(), local));
    return vertex;
}

Parents ShadingCache::parents_of(const ParentSet& set) {
    std::size_t count = 0;
    while (count < set.vertices.size() && set.vertices[count] != VertexId::none) ++count;
    return {std::span(set.vertices).first(count), set.weights.data()};
}

VertexId ShadingCache::add_vertex(CacheVertex vertex, const ParentSet& parents) {
    if (parents.vertices[0] != VertexId::none) {
        vertex.ends[0] = static_cast<VertexId>(parent_sets_.size());
        append(parent_sets_, parents, kAtOnce);
    }
    return add_vertex(vertex);
}

VertexId ShadingCache::add_vertex(const CacheVertex& vertex) {
    const std::size_t part = vertex.of_mesh ? kAtOnce : kOften;
    append(vertices_, vertex, part);
    append(changed_, std::uint8_t{0}, part);
    append(notes_, Notes{}, part);
    const auto made = static_cast<VertexId>(vertices_.size() - 1);
    estimates_.add_vertex(part);
    for (ShownValues& shown : shown_) shown.add_vertex(part);
    resolve_vertex(made);
    return made;
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

std::uint8_t ShadingCache::reflectance(VertexId id) const {
    return reflectances_[index_of(material_of(*scene_, surface_point(id)))];
}

std::size_t ShadingCache::bytes() const {
    std::size_t total = bytes_of(first_primitive_) + bytes_of(first_mesh_vertex_) +
                        bytes_of(reflectances_) + bytes_of(roots_) + bytes_of(mesh_vertices_) +
                        bytes_of(patches_) + bytes_of(vertices_) + bytes_of(parent_sets_) +
                        bytes_of(notes_) + edges_.bytes() + estimates_.bytes() + bytes_of(changed_);
    for (const ShownValues& shown : shown_) total += shown.bytes();
    return total;
}

}  // namespace chiaro
