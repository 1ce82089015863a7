// Deleting patches: a collapse marks, a pack() moves what stays together. Rare, so that no other
// code has to live with holes or reused ids.

#include "shading_cache/arrays.h"
#include "shading_cache/shading_cache.h"

namespace chiaro {
namespace {

// Old index to new, for what is kept; order is kept too.
template <typename Id>
std::vector<Id> renumber(const std::vector<char>& kept) {
    std::vector<Id> renumbered(kept.size(), Id::none);
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) renumbered[i] = static_cast<Id>(next++);
    return renumbered;
}

}  // namespace

void ShadingCache::collapse(PatchId id) {
    Patch& p = patch(id);
    p.split = Split::none;
    p.first_child = PatchId::none;
    p.refined_channels = 0;
}

void ShadingCache::pack() {
    ++packs_;
    // What the roots still reach stays, and all vertices that these patches and their graph need.
    std::vector<char> patch_kept(patches_.size(), 0);
    for (const PatchId root : roots_)
        if (root != PatchId::none) patch_kept[index_of(root)] = 1;
    for (std::size_t i = 0; i < patches_.size(); ++i)  // parents come before children
        if (patch_kept[i])
            for (int c = 0; c < child_count(patches_[i].split); ++c)
                patch_kept[index_of(offset_by(patches_[i].first_child, c))] = 1;
    std::vector<char> vertex_kept(vertices_.size(), 0);
    for (std::size_t i = 0; i < patches_.size(); ++i)
        if (patch_kept[i])
            for (int c = 0; c < patches_[i].corner_count(); ++c)
                vertex_kept[index_of(patches_[i].corners[c])] = 1;
    for (std::size_t i = vertices_.size(); i-- > 0;)
        if (vertex_kept[i])
            for (const VertexId parent : parents(static_cast<VertexId>(i)))
                vertex_kept[index_of(parent)] = 1;

    const auto new_patch = renumber<PatchId>(patch_kept);
    const auto new_vertex = renumber<VertexId>(vertex_kept);
    for (Patch& p : patches_) {
        for (VertexId& corner : p.corners)
            if (corner != VertexId::none) corner = new_vertex[index_of(corner)];
        if (!p.is_root()) p.parent = static_cast<std::uint32_t>(new_patch[p.parent]);
        if (!p.is_leaf()) p.first_child = new_patch[index_of(p.first_child)];
    }
    pack_parents(vertex_kept, new_vertex, new_patch);
    for (PatchId& root : roots_)
        if (root != PatchId::none) root = new_patch[index_of(root)];
    for (VertexId& id : mesh_vertices_)
        if (id != VertexId::none) id = new_vertex[index_of(id)];

    estimates_.pack(vertex_kept);
    for (ShownValues& shown : shown_) shown.pack(vertex_kept);
    keep_only(patches_, patch_kept);
    keep_only(vertices_, vertex_kept);
    keep_only(notes_, vertex_kept);
    keep_only(changed_, vertex_kept);
    first_changed_ = 0;
    edges_.clear();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        if (vertices_[i].halves_edge()) edges_.insert(static_cast<VertexId>(i), vertices_);
    }
}

// Parents by their new ids, and the sets of those vertices alone that are kept. What a kept vertex
// centres is kept, since nothing but its children has it for a corner or hangs on it.
void ShadingCache::pack_parents(const std::vector<char>& vertex_kept,
                                std::span<const VertexId> new_vertex,
                                std::span<const PatchId> new_patch) {
    const auto renew = [&](VertexId& id) {
        if (id != VertexId::none) id = new_vertex[index_of(id)];
    };
    std::vector<ParentSet> packed;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        CacheVertex& v = vertices_[i];
        if (v.halves_edge()) {
            for (VertexId& end : v.ends) renew(end);
        } else if (!vertex_kept[i] || v.ends[0] == VertexId::none) {
            continue;
        } else if (!v.of_mesh) {
            v.ends[0] = static_cast<VertexId>(new_patch[index_of(v.ends[0])]);
        } else {
            packed.push_back(parent_sets_[index_of(v.ends[0])]);
            for (VertexId& parent : packed.back().vertices) renew(parent);
            v.ends[0] = static_cast<VertexId>(packed.size() - 1);
        }
    }
    packed.shrink_to_fit();
    parent_sets_ = std::move(packed);
}

}  // namespace chiaro
