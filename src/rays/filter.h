// What see-through surfaces, and the camera, let pass, asked by Embree at every possible hit.
#pragma once

#include "rays/embree_scene.h"
#include "rays/ray_caster.h"

#include <embree3/rtcore.h>

#include <array>

namespace chiaro {

inline constexpr std::size_t kPacket = 16;

/// Blended surfaces that one ray meets on its way; the nearest kMostLayers, in no order.
struct LayersMet {
    std::uint32_t count = 0;
    std::array<RawHit, kMostLayers> hits;
};

/// Hits of one ray on the seams of an object's primitives. Embree tells of a hit on the diagonal of
/// a quad, or on an edge that two primitives share, once for each side; the surface counts once.
struct SeamsMet {
    static constexpr std::uint32_t kMost = 4;
    std::uint32_t count = 0;
    std::array<std::uint32_t, kMost> objects;
    std::array<float, kMost> t;
};

/// What a cast wants to know of blended surfaces; smooth panes stop all rays but those of
/// `through`.
enum class FilterKind {
    chance,   // each stops a ray with the probability of its alpha
    through,  // none stops a ray; `through` takes what they leave
    layers,   // none stops a ray; `layers` takes the hits
};

/// Embree's context of the cast of one packet, followed by what our filter reads and writes; Embree
/// hands it through by address. A lane's id is its place in the arrays.
struct PacketContext {
    RTCIntersectContext embree;
    const EmbreeScene* embree_scene;
    const Scene* scene;
    FilterKind kind;
    bool camera;      // single-sided backs let the rays pass
    const Ray* rays;  // of the packet
    Rgb* through = nullptr;
    SeamsMet* seams = nullptr;  // with `through`
    LayersMet* layers = nullptr;
    RayLog* log = nullptr;  // takes packets before they are cast
};

/// Drops the hits that the PacketContext says to pass through.
void see_through_filter(const RTCFilterFunctionNArguments* arguments);

}  // namespace chiaro
