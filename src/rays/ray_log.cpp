#include "rays/ray_log.h"

#include "base/error.h"
#include "rays/packet.h"

#include <algorithm>
#include <cstring>
#include <ctime>

namespace chiaro {
namespace {

// Packets that are laid out, then cast: few enough to stay in the nearest caches.
constexpr std::size_t kReplayed = 64;

struct LaidOut {
    RTCRayHit16 packet;
    alignas(64) int active[kPacket];
};

double thread_seconds() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void copy_row(float* to, const LoggedPacket::Lanes& from) {
    std::memcpy(to, from.data(), sizeof(from));
}

void lay_out(const LoggedPacket& logged, LaidOut& to) {
    RTCRay16& ray = to.packet.ray;
    copy_row(ray.org_x, logged.origin[0]);
    copy_row(ray.org_y, logged.origin[1]);
    copy_row(ray.org_z, logged.origin[2]);
    copy_row(ray.dir_x, logged.direction[0]);
    copy_row(ray.dir_y, logged.direction[1]);
    copy_row(ray.dir_z, logged.direction[2]);
    copy_row(ray.tnear, logged.t_min);
    copy_row(ray.tfar, logged.t_max);
    fill_constant_rows(ray);
    forget_hits(to.packet.hit);
    std::memcpy(to.active, logged.active.data(), sizeof(to.active));
}

}  // namespace

std::size_t RayLog::rays() const {
    std::size_t count = 0;
    for (const LoggedPacket& packet : packets)
        count += std::count(packet.active.begin(), packet.active.end(), -1);
    return count;
}

void write_down(const RTCRay16& packet, const int* active, bool occlusion,
                const PacketContext& context, RayLog& log) {
    const auto row = [](const float* from) {
        LoggedPacket::Lanes lanes;
        std::copy_n(from, kPacket, lanes.begin());
        return lanes;
    };
    LoggedPacket logged = {
        .origin = {row(packet.org_x), row(packet.org_y), row(packet.org_z)},
        .direction = {row(packet.dir_x), row(packet.dir_y), row(packet.dir_z)},
        .t_min = row(packet.tnear),
        .t_max = row(packet.tfar),
        .active = {},
        .occlusion = occlusion,
        .coherent = context.embree.flags == RTC_INTERSECT_CONTEXT_FLAG_COHERENT,
    };
    std::copy_n(active, kPacket, logged.active.begin());
    log.packets.push_back(logged);
}

double replay(const RayCaster& caster, std::span<const LoggedPacket> packets) {
    const EmbreeScene& embree = caster.embree_->scene;
    check(!embree.any_filter(), "replay: a surface that rays may pass");
    PacketContext coherent = make_context(embree, *caster.scene_, {.coherent = true});
    PacketContext incoherent = make_context(embree, *caster.scene_, {});
    std::vector<LaidOut> some(std::min(kReplayed, packets.size()));
    double seconds = 0;
    for (std::size_t first = 0; first < packets.size(); first += kReplayed) {
        const std::size_t count = std::min(kReplayed, packets.size() - first);
        for (std::size_t i = 0; i < count; ++i) lay_out(packets[first + i], some[i]);

        const double start = thread_seconds();
        for (std::size_t i = 0; i < count; ++i) {
            const LoggedPacket& logged = packets[first + i];
            RTCIntersectContext& context = (logged.coherent ? coherent : incoherent).embree;
            if (logged.occlusion)
                rtcOccluded16(some[i].active, embree.top(), &context, &some[i].packet.ray);
            else
                rtcIntersect16(some[i].active, embree.top(), &context, &some[i].packet);
        }
        seconds += thread_seconds() - start;
    }
    return seconds;
}

}  // namespace chiaro
