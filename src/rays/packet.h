// Packets of rays on their way to Embree; only the files of this folder include this.
#pragma once

#include "rays/embree_scene.h"
#include "rays/filter.h"
#include "rays/ray_caster.h"

namespace chiaro {

/// What RayCaster hides from those who include it.
struct RayCaster::Embree {
    EmbreeScene scene;
};

struct CastSettings {
    FilterKind kind = FilterKind::chance;
    bool camera = false;
    bool coherent = false;
};
PacketContext make_context(const EmbreeScene& embree, const Scene& scene,
                           const CastSettings& settings);

/// Switches what Embree finds in each lane back to nothing.
inline void forget_hits(RTCHit16& hit) {
    for (std::size_t i = 0; i < kPacket; ++i) {
        hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
}

/// What is the same in all packets. `mask` and `flags` are zero or all, `id` is the lane.
inline void fill_constant_rows(RTCRay16& packet) {
    for (std::size_t i = 0; i < kPacket; ++i) {
        packet.time[i] = 0;
        packet.mask[i] = 0xffff'ffffU;
        packet.id[i] = static_cast<unsigned>(i);
        packet.flags[i] = 0;
    }
}

/// Appends the packet, not yet cast, to the log.
void write_down(const RTCRay16& packet, const int* active, bool occlusion,
                const PacketContext& context, RayLog& log);

}  // namespace chiaro
