// The records of the Shading Cache (3, 3.1): patches in trees, vertices in one graph.
#pragma once

#include "base/bfloat16.h"
#include "base/color.h"
#include "base/ids.h"
#include "shading_cache/split.h"

#include <array>
#include <cstdint>
#include <span>

namespace chiaro {

/// Counts finished update cycles. Ages are differences of cycles, never wall-clock time (5.1).
using Cycle = std::uint32_t;

/// Positions in the cache's arrays; valid until age_out() packs them.
enum class PatchId : std::uint32_t { none = 0xffff'ffff };
enum class VertexId : std::uint32_t { none = 0xffff'ffff };

inline PatchId offset_by(PatchId id, int n) {
    return static_cast<PatchId>(static_cast<std::uint32_t>(id) + static_cast<std::uint32_t>(n));
}

/// One cell of a patch tree. Leaves are drawn.
///
/// A channel need not be evaluated as deep as the tree goes: it is refined in a patch when its
/// values at the children's new corners were asked for. Patches whose ancestors are all refined in
/// a channel and that are not themselves form that channel's front, where its refinement goes on.
struct Patch {
    /// Patches of this level are not divided: places on them are as close as floats tell apart.
    static constexpr int kDeepest = 22;

    std::array<VertexId, 4> corners;      // counter-clockwise; corners[3] is none on a triangle
    std::uint32_t parent;                 // a PatchId; on a root, the index of its surface side
    PatchId first_child = PatchId::none;  // the children are consecutive
    std::uint32_t first_fragment = 0;     // what of the view lies on it: IdMap::order
    std::uint32_t fragment_count = 0;
    Cycle last_seen = 0;  // last cycle known to have seen it; of what is in view, see attach()
    Split split = Split::none;
    std::uint8_t level = 0;             // 0 on a root
    std::uint8_t refined_channels = 0;  // bit c: channel c is refined here
    std::uint8_t reflectance = 255;     // mean luminance of the root's base colour, 255 is 1
    // What its irradiance, and its glossy radiance, weigh in the picture, in pixels that show the
    // patch alone and straight: squared, as errors count (IdMap).
    Bfloat16 pixels = 0;
    Bfloat16 glossy_pixels = 0;

    bool is_root() const { return level == 0; }
    bool is_leaf() const { return split == Split::none; }
    bool divisible() const { return level < kDeepest; }
    bool is_quad() const { return corners[3] != VertexId::none; }
    int corner_count() const { return is_quad() ? 4 : 3; }
    bool refined(int channel) const { return refined_channels >> channel & 1; }
};

/// A surface point with 0 to 4 weighted parents, from whose values its own is predicted (Parents).
/// Below the mesh these are the ends of the edge it halves or the corners of the quad it centres; a
/// corner of the mesh has vertices of a coarser level (mesh_graph.h), or none. Parents come earlier
/// in the array than their children, so that one pass in order carries values from coarse to fine.
struct CacheVertex {
    static constexpr int kSideBits = 28;

    // The ends of the edge that it halves, its parents in equal parts. Otherwise the second is
    // none, and the first is the patch that it centres, as a PatchId; on a mesh the place of its
    // ParentSet, or none where there are no parents: see ShadingCache::parents().
    std::array<VertexId, 2> ends = {VertexId::none, VertexId::none};
    std::uint32_t surface_side : kSideBits = 0;  // of the root on which it is sampled
    std::uint32_t of_mesh : 1 = 0;  // a corner of the mesh, not made by dividing patches
    std::uint32_t exposed : 1 = 0;  // it was seen not to be buried, whatever rays met
    std::uint32_t buried : 1 = 0;  // most rays from it met the inside of a solid: it knows no light
    Vec2 uv = Vec2(0);  // where it is sampled: pulled in from the patch's border by 0.2 %

    void set_surface_side(std::uint32_t side) {
        surface_side = side & ((std::uint32_t{1} << kSideBits) - 1);
    }
    bool halves_edge() const { return ends[1] != VertexId::none; }
};

/// Parents with weights of a vertex of a mesh: the first ones of these.
struct ParentSet {
    std::array<VertexId, 4> vertices = {VertexId::none, VertexId::none, VertexId::none,
                                        VertexId::none};
    std::array<std::uint8_t, 4> weights = {0, 0, 0, 0};  // multiples of 1/128
};

/// The parents of one vertex, from 0 to 4.
class Parents {
public:
    static constexpr int kFullWeight = 128;  // sum of the weights
    static constexpr std::array<std::uint8_t, 2> kHalves = {kFullWeight / 2, kFullWeight / 2};
    static constexpr std::array<std::uint8_t, 4> kQuarters = {kFullWeight / 4, kFullWeight / 4,
                                                              kFullWeight / 4, kFullWeight / 4};

    Parents() = default;
    Parents(std::span<const VertexId> vertices, const std::uint8_t* weights)
        : vertices_(vertices), weights_(weights) {}

    std::size_t size() const { return vertices_.size(); }
    bool empty() const { return vertices_.empty(); }
    VertexId operator[](std::size_t i) const { return vertices_[i]; }
    auto begin() const { return vertices_.begin(); }
    auto end() const { return vertices_.end(); }
    std::span<const VertexId> vertices() const { return vertices_; }
    /// Of kFullWeight.
    std::uint8_t whole_weight(std::size_t i) const { return weights_[i]; }
    /// Share of parent i in the prediction, in [0, 1].
    float weight(std::size_t i) const { return static_cast<float>(weights_[i]) / kFullWeight; }

private:
    std::span<const VertexId> vertices_;
    const std::uint8_t* weights_ = nullptr;
};

/// What is known of one channel at one vertex; 20 bytes, as there are many.
///
/// A stale one is of the scene before an edit. It is shown until there is a new one, whose samples
/// take its place and are not mixed with it. Its variance holds how far it may be off by now, and
/// its samples are as many as would tell as much.
struct Estimate {
    static constexpr float kUnknown = -1;
    static constexpr std::uint32_t kMostSamples = (1U << 18) - 1;
    static constexpr Cycle kCycleMask = (1U << 13) - 1;

    Rgb mean = Rgb(0);      // irradiance [lux a colour channel], or radiance of a glossy channel
    Bfloat16 variance = 0;  // of the mean's luminance [lux^2]
    Bfloat16 surplus = 0;   // luminance by which the first mean missed its prediction, less noise
                            // [lux]; kUnknown where there was none
    std::uint32_t samples : 18 = 0;    // counted up to kMostSamples
    std::uint32_t shaded_at : 13 = 0;  // cycle, of which the lower bits: ages go up to kCycleMask
    std::uint32_t stale : 1 = 0;
};

}  // namespace chiaro
