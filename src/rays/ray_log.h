// Rays written down as they go to Embree, to be cast again by Embree alone: how fast a program
// could be that did nothing but cast them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace chiaro {

class RayCaster;

/// One packet of rays: what Embree is given, lane by lane.
struct LoggedPacket {
    using Lanes = std::array<float, 16>;
    alignas(64) Lanes origin[3];
    Lanes direction[3];
    Lanes t_min, t_max;
    std::array<int, 16> active;  // -1: cast, 0: not
    bool occlusion;              // asks whether something is in the way, not what is nearest
    bool coherent;               // the flag that it was cast with
};

/// Packets in the order that they were cast in.
struct RayLog {
    std::vector<LoggedPacket> packets;

    /// Lanes that were cast.
    std::size_t rays() const;
};

/// Casts the packets again, in their order, and returns the seconds of this thread's processor time
/// that Embree alone took. What it finds is forgotten. Checks: the caster's scene has no surface
/// that rays may pass, which filters would be asked about.
double replay(const RayCaster& caster, std::span<const LoggedPacket> packets);

}  // namespace chiaro
