#include "rays/ray_caster.h"

#include "base/error.h"
#include "rays/embree_scene.h"
#include "rays/filter.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr std::size_t kPacket = 16;
constexpr float kFarthest = 1e18f;  // Embree refuses coordinates above 1.8e18

bool valid(const Ray& ray) {
    // One comparison for all: a sum is not below the bound if any term is large, infinite or a NaN.
    const Vec3 sum = glm::abs(ray.origin) + glm::abs(ray.direction);
    return sum.x + sum.y + sum.z < kFarthest && ray.t_min >= 0 && ray.t_max == ray.t_max;
}

// Rays as Embree wants them: component by component. Lanes without a ray repeat the first one,
// since every lane must be finite, and are switched off.
void fill_rays(RTCRay16& packet, int* active, std::span<const Ray> rays, std::size_t first) {
    const std::size_t count = std::min(kPacket, rays.size() - first);
    for (std::size_t i = 0; i < kPacket; ++i) {
        const Ray& ray = rays[first + (i < count ? i : 0)];
        const bool on = i < count && ray.t_min <= ray.t_max;
        packet.org_x[i] = ray.origin.x;
        packet.org_y[i] = ray.origin.y;
        packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x;
        packet.dir_y[i] = ray.direction.y;
        packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = ray.t_min;
        packet.tfar[i] = on ? ray.t_max : -1.0f;
        packet.time[i] = 0;
        packet.mask[i] = 0xffff'ffffU;
        packet.id[i] = static_cast<unsigned>(first + i);
        packet.flags[i] = 0;
        active[i] = on ? -1 : 0;
    }
}

CastContext make_context(std::span<const Ray> rays, RayKind kind, bool coherent) {
    for (const Ray& ray : rays) check(valid(ray), "RayCaster: a ray is not finite");
    CastContext context;
    rtcInitIntersectContext(&context.embree);
    context.embree.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context.rays = rays;
    context.kind = kind;
    return context;
}

Hit make_hit(const EmbreeScene& scene, const RTCRayHit16& packet, std::size_t lane,
             const Ray& ray) {
    const RTCHit16& found = packet.hit;
    if (found.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return {};
    const std::uint32_t object = found.instID[0][lane];
    const std::uint32_t first = scene.first_primitive(object, found.geomID[lane]);

    Hit hit;
    hit.point = {static_cast<ObjectId>(object), first + found.primID[lane],
                 std::clamp(found.u[lane], 0.0f, 1.0f), std::clamp(found.v[lane], 0.0f, 1.0f)};
    hit.t = packet.ray.tfar[lane];
    const Vec3 normal =
        scene.normal_to_world(object) * Vec3(found.Ng_x[lane], found.Ng_y[lane], found.Ng_z[lane]);
    hit.normal = normal * (1.0f / std::sqrt(glm::dot(normal, normal)));
    hit.front = glm::dot(hit.normal, ray.direction) < 0;
    return hit;
}

void intersect_packets(const EmbreeScene& scene, std::span<const Ray> rays, std::span<Hit> hits,
                       CastContext context) {
    alignas(64) int active[kPacket];
    RTCRayHit16 packet;
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        fill_rays(packet.ray, active, rays, first);
        for (std::size_t i = 0; i < kPacket; ++i) {
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(active, scene.top(), &context.embree, &packet);
        const std::size_t count = std::min(kPacket, rays.size() - first);
        for (std::size_t i = 0; i < count; ++i)
            hits[first + i] = make_hit(scene, packet, i, rays[first + i]);
    }
}

}  // namespace

struct RayCaster::Embree {
    EmbreeScene scene;
};

RayCaster::RayCaster(const Scene& scene, int threads)
    : scene_(&scene), embree_(new Embree{EmbreeScene(scene, threads)}) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

void RayCaster::intersect(std::span<const Ray> rays, std::span<Hit> hits, RayKind kind) const {
    check(rays.size() == hits.size(), "intersect: one hit a ray");
    intersect_packets(embree_->scene, rays, hits, make_context(rays, kind, false));
}

void RayCaster::intersect_coherent(std::span<const Ray> rays, std::span<Hit> hits,
                                   RayKind kind) const {
    check(rays.size() == hits.size(), "intersect_coherent: one hit a ray");
    intersect_packets(embree_->scene, rays, hits, make_context(rays, kind, true));
}

void RayCaster::occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
    check(rays.size() == blocked.size(), "occluded: one answer a ray");
    CastContext context = make_context(rays, RayKind::transport, false);
    alignas(64) int active[kPacket];
    RTCRay16 packet;
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        fill_rays(packet, active, rays, first);
        rtcOccluded16(active, embree_->scene.top(), &context.embree, &packet);

        // Embree marks a blocked ray by an infinite negative end.
        const std::size_t count = std::min(kPacket, rays.size() - first);
        for (std::size_t i = 0; i < count; ++i)
            blocked[first + i] = active[i] != 0 && packet.tfar[i] == -kInfinity;
    }
}

void RayCaster::set_transform(ObjectId object) {
    embree_->scene.set_transform(*scene_, object);
}

float RayCaster::offset(Vec3 position) {
    const Vec3 p = glm::abs(position);
    return 1e-6f + 1e-5f * std::max(p.x, std::max(p.y, p.z));
}

float RayCaster::offset(Vec3 position, ObjectId object) const {
    return offset(position) + 1e-6f * embree_->scene.extent(static_cast<std::uint32_t>(object));
}

}  // namespace chiaro
