// Roots and the vertices of meshes, made when first seen: the part of a mesh that costs anything.

#include "shading_cache/arrays.h"
#include "shading_cache/shading_cache.h"

#include <algorithm>

namespace chiaro {

static_assert(MeshGraph::kFullWeight == Parents::kFullWeight);  // weights are taken as they are
static_assert(2 * kMostPrimitives <= std::size_t{1} << CacheVertex::kSideBits);

/// One side of a mesh in its place in the scene, with what its ids are counted from.
struct ShadingCache::MeshPlace {
    const Mesh& mesh;
    const MeshGraph& graph;
    std::uint32_t first_primitive;
    std::uint32_t first_vertex;
    std::uint32_t back;  // 1 on the back side

    std::uint32_t side_of(std::uint32_t primitive) const {
        return 2 * (first_primitive + primitive) + back;
    }
    Vec2 uv_of(MeshCorner corner) const {
        const bool quad = mesh.primitives[corner.primitive].is_quad();
        return pulled_in(quad, node_place(quad, static_cast<Node>(corner.corner)));
    }
};

ShadingCache::MeshPlace ShadingCache::mesh_place(std::uint32_t surface_side) const {
    const std::size_t object = index_of(place(surface_side, Vec2(0)).object);
    const Object& o = scene_->objects[object];
    return {scene_->mesh_of(o), graphs_->of(o.mesh), first_primitive_[object],
            first_mesh_vertex_[object], surface_side & 1};
}

PatchId ShadingCache::known_root(ObjectId object, std::uint32_t primitive, bool front) const {
    return roots_[2 * (first_primitive_[index_of(object)] + primitive) + (front ? 0 : 1)];
}

PatchId ShadingCache::root(ObjectId object, std::uint32_t primitive, bool front) {
    const std::uint32_t side =
        2 * (first_primitive_[index_of(object)] + primitive) + (front ? 0 : 1);
    if (roots_[side] != PatchId::none) return roots_[side];

    const MeshPlace place = mesh_place(side);
    const Primitive& p = place.mesh.primitives[primitive];
    Patch patch;
    patch.corners.fill(VertexId::none);
    patch.parent = side;
    patch.reflectance = reflectances_[index_of(p.material)];
    for (int c = 0; c < p.corner_count(); ++c) {
        const MeshCorner corner = {primitive, c};
        const std::uint32_t vertex = place.graph.vertex_of_corner[corner_index(place.mesh, corner)];
        const VertexId id = mesh_vertex(place, static_cast<MeshVertexId>(vertex), corner);
        if (relocated(id)) {
            note_forgotten(id, kAllChannels);
            estimates_.forget(id, kAllChannels);
            put(id, side, place.uv_of(corner));
        }
        notes_[index_of(id)].of_root = 1;
        patch.corners[c] = id;
    }
    roots_[side] = static_cast<PatchId>(patches_.size());
    append(patches_, patch, kAtOnce);
    return roots_[side];
}

// The cache's vertex for one of the mesh, after those that predict it. A corner in view is sampled
// on the primitive that is in view, the others where their graph says.
VertexId ShadingCache::mesh_vertex(const MeshPlace& place, MeshVertexId vertex,
                                   MeshCorner sampled_at) {
    VertexId& id = mesh_vertices_[2 * (place.first_vertex + index_of(vertex)) + place.back];
    if (id != VertexId::none) return id;

    CacheVertex made;
    made.of_mesh = 1;
    made.set_surface_side(place.side_of(sampled_at.primitive));
    made.uv = place.uv_of(sampled_at);
    const auto parents = place.graph.parents_of(vertex);
    const auto weights = place.graph.weights_of(vertex);
    ParentSet set;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const MeshCorner corner = corner_at(place.mesh, place.graph.corner_of_vertex[parents[i]]);
        set.vertices[i] = mesh_vertex(place, static_cast<MeshVertexId>(parents[i]), corner);
        set.weights[i] = weights[i];
    }
    id = add_vertex(made, set);
    const int level = std::min<int>(place.graph.level[index_of(vertex)], kCoarsestLevel);
    notes_[index_of(id)].level = static_cast<std::uint8_t>(level) & kCoarsestLevel;
    return id;
}

void ShadingCache::relocate(VertexId hidden, VertexId in_view) {
    check(vertex(hidden).of_mesh && !of_root(hidden), "relocate: the vertex may be in view");
    check(!evaluated(hidden), "relocate: the vertex is evaluated where it is");
    put(hidden, vertex(in_view).surface_side, vertex(in_view).uv);
    notes_[index_of(hidden)].relocated = 1;
}

// What was found of the place where it was sampled before no longer counts.
void ShadingCache::put(VertexId id, std::uint32_t surface_side, Vec2 uv) {
    CacheVertex& v = vertices_[index_of(id)];
    v.set_surface_side(surface_side);
    v.uv = uv;
    v.buried = v.exposed = 0;
    notes_[index_of(id)].relocated = 0;
    resolve_vertex(id);
}

}  // namespace chiaro
