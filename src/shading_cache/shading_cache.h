// BOX Shading Cache: an object-space hierarchy of patches, shaded lazily at its vertices.
// Source: Tole, Pellacini, Walter, Greenberg, "Interactive Global Illumination in Dynamic Scenes",
// SIGGRAPH 2002, sections 3 and 3.1. Section numbers in this project always refer to that paper.
#pragma once

#include "scene/surface.h"
#include "shading_cache/edge_table.h"
#include "shading_cache/estimate_table.h"
#include "shading_cache/mesh_graph.h"
#include "shading_cache/patch.h"
#include "shading_cache/shown_values.h"

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace chiaro {

/// How patches are divided: always into four as in 3.1, or by their shape (split.h).
enum class SplitRule { always_four, by_shape };

/// How many channels a cache has, which is fixed for its life. The first ones hold parts of the
/// irradiance; the others parts of the exitant radiance toward one eye [cd/m2 a colour channel], on
/// surfaces that are not diffuse.
struct Channels {
    int irradiance = 1;
    int glossy = 0;
};

/// What channels hold.
enum class Shading { irradiance, glossy };

/// A value of one channel, and what it weighs in an interpolation: 0 where the vertex is hollow,
/// else 1.
struct Shown {
    Rgb value;
    float weight;
};

/// Owns all patches and vertices and keeps their links consistent; knows nothing of rays or pixels.
///
/// Thread: the update thread. Const calls from several threads at once are safe.
/// Ids: stay valid until pack() moves what they name.
class ShadingCache {
public:
    /// No patches yet: roots are made when first asked for. `scene` and `graphs`, of its meshes,
    /// must outlive the cache. Checks: 1 to 8 channels.
    ShadingCache(const Scene& scene, const MeshGraphs& graphs, Channels channels, SplitRule rule);

    int channels() const { return static_cast<int>(shown_.size()); }
    /// What a channel holds.
    Shading shading(int channel) const {
        return channel < irradiance_channels_ ? Shading::irradiance : Shading::glossy;
    }
    bool has_glossy() const { return irradiance_channels_ < channels(); }
    const Scene& scene() const { return *scene_; }
    std::span<const Patch> patches() const { return patches_; }
    std::span<Patch> patches() { return patches_; }
    std::span<const CacheVertex> vertices() const { return vertices_; }
    Patch& patch(PatchId id) { return patches_[index_of(id)]; }
    const Patch& patch(PatchId id) const { return patches_[index_of(id)]; }
    const CacheVertex& vertex(VertexId id) const { return vertices_[index_of(id)]; }

    /// The root patch on one side of a primitive; made, unshaded, when first asked for (3:
    /// "evaluated lazily"), and so are its corners and all vertices above these.
    PatchId root(ObjectId object, std::uint32_t primitive, bool front);
    /// That root, if somebody has asked for it; else none.
    PatchId known_root(ObjectId object, std::uint32_t primitive, bool front) const;

    /// Divides `leaf` and returns the first child. Midpoints that a neighbour has made already are
    /// shared, so that nothing is shaded twice. Checks: `leaf` has no children and is divisible.
    PatchId subdivide(PatchId leaf);

    /// Deletes everything below `patch`, which becomes a leaf, at the next pack() (3.1, aging).
    void collapse(PatchId patch);

    /// Gives up what was collapsed and moves the rest together, in order. All ids change.
    void pack();
    /// How often that was.
    std::size_t packs() const { return packs_; }

    /// What a vertex's values are predicted from. Valid until vertices or patches are added.
    Parents parents(VertexId vertex) const {
        const CacheVertex& v = this->vertex(vertex);
        if (v.halves_edge()) return {v.ends, Parents::kHalves.data()};
        if (v.ends[0] == VertexId::none) return {};
        if (!v.of_mesh) return {patches_[index_of(v.ends[0])].corners, Parents::kQuarters.data()};
        return parents_of(parent_sets_[index_of(v.ends[0])]);
    }

    /// The midpoint that somebody has put on the edge between two vertices.
    std::optional<VertexId> midpoint(VertexId a, VertexId b) const;

    /// The child's place among its siblings. Checks: not a root.
    int child_index(PatchId child) const;
    /// The surface side on which the patch lies, and (u, v) there of one of its local points.
    std::uint32_t surface_side(PatchId patch) const;
    Vec2 surface_uv(PatchId patch, Vec2 local) const;
    /// Where a vertex is sampled, and on which side.
    SurfacePoint surface_point(VertexId vertex) const;
    bool on_front(VertexId vertex) const { return (this->vertex(vertex).surface_side & 1) == 0; }
    /// Mean luminance of the base colour there, 255 is 1.
    std::uint8_t reflectance(VertexId vertex) const;
    /// The coarsest level that a vertex of the mesh stands for (MeshGraph); 0 for all others.
    int level(VertexId vertex) const { return notes_[index_of(vertex)].level; }
    /// Samples a vertex of a mesh, which is hidden, where another is that is in view: what hides it
    /// may keep its light away. Once it is a corner of a root it is sampled where it is, for good.
    /// Checks: not a corner of a root, not evaluated.
    void relocate(VertexId hidden, VertexId in_view);
    bool of_root(VertexId vertex) const { return notes_[index_of(vertex)].of_root; }
    bool relocated(VertexId vertex) const { return notes_[index_of(vertex)].relocated; }
    /// What was forgotten since this was asked last, by forget() or by root() of relocated
    /// vertices: evaluated once, and no longer.
    std::vector<std::pair<VertexId, int>> take_forgotten() { return std::exchange(forgotten_, {}); }

    /// Estimate of a channel at a vertex, if it was evaluated there.
    const Estimate* estimate(VertexId vertex, int channel) const {
        return estimates_.find(vertex, channel);
    }
    bool evaluated(VertexId vertex, int channel) const {
        return estimates_.known(vertex) >> channel & 1;
    }
    /// In any channel.
    bool evaluated(VertexId vertex) const { return estimates_.known(vertex) != 0; }

    /// By how much the vertex's estimate missed its prediction (luminance); where there was none, a
    /// part of all light there. Checks: evaluated.
    float surplus(VertexId vertex, int channel) const;
    /// That part, of what tells nothing of what lies around it (luminance).
    float surplus_of_unknown(VertexId vertex, int channel) const;

    /// Raises a vertex's surplus to at least `luminance`: its children were found to differ more
    /// than it would tell. Returns whether it was less. Checks: evaluated.
    bool suspect(VertexId vertex, int channel, float luminance);

    /// Merges `samples` further samples with their `mean` and the luminance variance of that mean;
    /// they replace a stale estimate. The first time, and then, notes the surplus over the parents'
    /// prediction; later less of it, if that turns out to have been noise. Checks: finite, samples
    /// > 0.
    void store(VertexId vertex, int channel, Rgb mean, float variance, std::uint32_t samples,
               Cycle now);
    /// An edit has reached what an estimate, if there is one, tells: it is stale, and may be off by
    /// `error2` (expected squared error of its luminance). Again: now by so much.
    void outdate(VertexId vertex, int channel, float error2);
    /// Gives up what channels (bit c: channel c) know at a vertex, which is predicted then.
    void forget(VertexId vertex, std::uint8_t channels);
    /// Gives up all that is known at a vertex, and whether it is buried, as if it were new.
    void forget(VertexId vertex);
    static constexpr std::uint8_t kAllChannels = 0xff;

    /// Objects, meshes and materials may have been appended to the scene, whose graphs have them,
    /// and these materials are not what they were.
    void follow_scene(std::span<const MaterialId> repainted);

    /// Most rays from the vertex met the inside of a solid (design: buried vertices).
    void mark_buried(VertexId vertex);
    /// More samples have told otherwise.
    void unmark_buried(VertexId vertex);
    /// All channels of irradiance were evaluated, and none has found any light.
    bool dark(VertexId vertex) const;
    /// A vertex that was taken for buried is in view: its estimates count after all, and for good.
    void expose(VertexId vertex);
    /// Whether a part of what that kind of light comes to at a vertex is not known: it is buried or
    /// was not evaluated in all channels of that kind, and nor can its parents predict them, all of
    /// which are hollow too. It leaves the interpolation, as half of its light would be a dark
    /// spot.
    bool hollow(VertexId vertex, Shading shading) const {
        const Notes& notes = notes_[index_of(vertex)];
        return shading == Shading::glossy ? notes.hollow_in_gloss : notes.hollow;
    }
    /// Corners of a patch that are buried.
    int buried_corners(const Patch& patch) const;

    /// The channel's value at a vertex as it was last resolved: the estimate, or what the parents
    /// predict where there is none or the vertex is buried.
    Shown shown(VertexId vertex, int channel) const;
    /// Sum of all channels that hold the one or the other.
    Shown shown_total(VertexId vertex, Shading shading = Shading::irradiance) const;
    /// What the channel weighs in the picture, on that patch.
    float pixels(const Patch& patch, int channel) const {
        return shading(channel) == Shading::irradiance ? patch.pixels : patch.glossy_pixels;
    }

    /// Gives up all that glossy channels hold, as the eye has moved, and their refinement.
    void forget_glossy();

    /// Carries values from coarse to fine. store() resolves its own vertex; this brings what
    /// depends on it up to date: 1 to 2 ns for each vertex after the first that changed, and more
    /// only for those whose parents did.
    void resolve();
    /// Carries what the parents show in a channel to one vertex. Returns whether it shows something
    /// else now, or has become hollow or ceased to be.
    bool resolve(VertexId vertex, int channel);
    /// Whether a vertex's value or estimate in a channel has changed since forget_changes().
    bool changed(VertexId vertex, int channel) const {
        return changed_[index_of(vertex)] >> channel & 1;
    }
    /// Or in any channel.
    bool changed(VertexId vertex) const { return changed_[index_of(vertex)] != 0; }
    void forget_changes();

    /// Bytes that the cache's arrays and tables hold, unused capacity included.
    std::size_t bytes() const;

private:
    struct MeshPlace;
    static constexpr std::uint8_t kCoarsestLevel = 15;
    struct Notes {  // on a vertex
        std::uint8_t level : 4 = 0;
        std::uint8_t of_root : 1 = 0;
        std::uint8_t relocated : 1 = 0;
        std::uint8_t hollow : 1 = 0;
        std::uint8_t hollow_in_gloss : 1 = 0;
    };
    struct ChannelRange {
        int first, end;
    };
    ChannelRange channels_of(Shading shading) const;
    MeshPlace mesh_place(std::uint32_t surface_side) const;
    VertexId mesh_vertex(const MeshPlace& place, MeshVertexId vertex, MeshCorner sampled_at);
    void put(VertexId vertex, std::uint32_t surface_side, Vec2 uv);
    void note_forgotten(VertexId vertex, std::uint8_t channels);
    VertexId edge_midpoint(PatchId patch, Node node);
    VertexId node_vertex(PatchId patch, Node node);
    static Parents parents_of(const ParentSet& set);
    CacheVertex new_vertex(PatchId patch, Vec2 local) const;
    VertexId add_vertex(const CacheVertex& vertex);
    VertexId add_vertex(CacheVertex vertex, const ParentSet& parents);
    Split choose_split(PatchId leaf) const;
    bool tells(VertexId vertex, int channel) const;
    std::optional<Rgb> predicted(VertexId vertex, int channel) const;
    void resolve_hollow(VertexId vertex, Shading shading);
    void resolve_hollow(VertexId vertex);
    void set_buried(VertexId vertex, bool buried);
    float first_surplus(VertexId vertex, int channel, Rgb mean, float variance) const;
    void note_change(VertexId vertex, int channel);
    void resolve_vertex(VertexId vertex, int channel);
    void resolve_vertex(VertexId vertex);
    void show(VertexId vertex, int channel, Rgb value);
    void pack_parents(const std::vector<char>& vertex_kept, std::span<const VertexId> new_vertex,
                      std::span<const PatchId> new_patch);
    SurfacePoint place(std::uint32_t surface_side, Vec2 uv) const;

    static constexpr std::size_t kAtOnce = 8;  // roots come by the view: append(),
    static constexpr std::size_t kOften = 64;  // what divides them bit by bit

    const Scene* scene_;
    const MeshGraphs* graphs_;
    SplitRule rule_;
    int irradiance_channels_;
    std::vector<std::uint32_t> first_primitive_;    // of each object, in one count over all
    std::vector<std::uint32_t> first_mesh_vertex_;  // likewise
    std::vector<std::uint8_t> reflectances_;        // of each material, as Patch::reflectance
    std::vector<PatchId> roots_;           // by surface side: 2 x primitive + (back ? 1 : 0)
    std::vector<VertexId> mesh_vertices_;  // 2 x vertex + (back ? 1 : 0); none until first needed
    std::vector<Patch> patches_;
    std::vector<CacheVertex> vertices_;
    std::vector<ParentSet> parent_sets_;  // of vertices of meshes that have parents
    std::vector<Notes> notes_;            // by vertex
    EdgeTable edges_;

    EstimateTable estimates_;
    std::vector<ShownValues> shown_;  // by channel, in shown_unit_
    float shown_unit_ = 0x1p-60f;     // a power of two; raised when something brighter comes

    std::vector<std::pair<VertexId, int>> forgotten_;  // take_forgotten()
    std::size_t packs_ = 0;

    static constexpr std::size_t kNothing = ~std::size_t{0};
    std::vector<std::uint8_t> changed_;     // by vertex: bit c, in channel c
    std::size_t first_changed_ = kNothing;  // no vertex before it has changed
};

}  // namespace chiaro
