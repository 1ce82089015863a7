// Packets of rays on their way to Embree; only the files of this folder include this.
#pragma once

#include "base/vec8.h"
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

/// At most 16 rays as Embree wants them: component by component, but for fill_constant_rows().
/// Lanes without a ray repeat the first one, since every lane must be finite, and are switched off.
/// Checks: every ray is finite.
void fill_rays(RTCRay16& packet, int* active, std::span<const Ray> rays);

/// What one ray, or the first lanes of a packet that was cast, met.
Hit make_hit(const EmbreeScene& scene, const RawHit& raw, const Ray& ray);
void make_hits(const EmbreeScene& scene, const RTCRayHit16& packet, std::span<Hit> hits);

/// How far off a surface rays must start: what coordinates of the place and up to `extent` round
/// by, and more. For Vec3 and Vec3x8.
template <typename Vector, typename Number>
Number offset_at(const Vector& position, Number extent) {
    return Number(1e-6f) + Number(1e-5f) * largest(position) + Number(1e-6f) * extent;
}

/// Appends the packet, not yet cast, to the log.
void write_down(const RTCRay16& packet, const int* active, bool occlusion,
                const PacketContext& context, RayLog& log);

}  // namespace chiaro
