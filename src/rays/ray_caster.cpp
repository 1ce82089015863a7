#include "rays/ray_caster.h"

#include "base/error.h"
#include "rays/packet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace chiaro {
namespace {

constexpr float kFarthest = 1e18f;  // Embree refuses coordinates above 1.8e18

// Embree's asserts would end the process, even for a lane that is off. One comparison for all: a
// sum is not below the bound if any term is large, infinite or a NaN.
void check_rays(const RTCRay16& packet) {
    int finite = 1;
    for (std::size_t i = 0; i < kPacket; ++i) {
        const float sum = std::abs(packet.org_x[i]) + std::abs(packet.org_y[i]) +
                          std::abs(packet.org_z[i]) + std::abs(packet.dir_x[i]) +
                          std::abs(packet.dir_y[i]) + std::abs(packet.dir_z[i]);
        finite &= int(sum < kFarthest) & int(packet.tnear[i] >= 0) &
                  int(packet.tfar[i] == packet.tfar[i]);
    }
    check(finite != 0, "RayCaster: a ray is not finite");
}

// Rays as Embree wants them: component by component. Lanes without a ray repeat the first one,
// since every lane must be finite, and are switched off.
void fill_rays(RTCRay16& packet, int* active, std::span<const Ray> rays) {
    for (std::size_t i = 0; i < kPacket; ++i) {
        const Ray& ray = rays[i < rays.size() ? i : 0];
        const bool on = i < rays.size() && !(ray.t_min > ray.t_max);
        packet.org_x[i] = ray.origin.x;
        packet.org_y[i] = ray.origin.y;
        packet.org_z[i] = ray.origin.z;
        packet.dir_x[i] = ray.direction.x;
        packet.dir_y[i] = ray.direction.y;
        packet.dir_z[i] = ray.direction.z;
        packet.tnear[i] = ray.t_min;
        packet.tfar[i] = on ? ray.t_max : -1.0f;
        active[i] = on ? -1 : 0;
    }
    fill_constant_rows(packet);
    check_rays(packet);
}

std::span<const Ray> packet_at(std::span<const Ray> rays, std::size_t first) {
    return rays.subspan(first, std::min(kPacket, rays.size() - first));
}

Hit make_hit(const EmbreeScene& scene, const RawHit& raw, const Ray& ray) {
    Hit hit;
    hit.point = scene.point_of(raw);
    hit.t = raw.t;
    hit.normal = scene.normal_of(raw);
    hit.front = glm::dot(hit.normal, ray.direction) < 0;
    return hit;
}

Hit make_hit(const EmbreeScene& scene, const RTCRayHit16& packet, std::size_t lane,
             const Ray& ray) {
    const RTCHit16& found = packet.hit;
    if (found.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return {};
    return make_hit(scene,
                    {found.instID[0][lane],
                     found.geomID[lane],
                     found.primID[lane],
                     found.u[lane],
                     found.v[lane],
                     packet.ray.tfar[lane],
                     {found.Ng_x[lane], found.Ng_y[lane], found.Ng_z[lane]}},
                    ray);
}

// The same order of what lies in one place on every run.
bool nearer(const RawHit& a, const RawHit& b) {
    return std::tie(a.t, a.object, a.geometry, a.primitive) <
           std::tie(b.t, b.object, b.geometry, b.primitive);
}

void intersect_packet(RTCRayHit16& packet, std::span<const Ray> rays, PacketContext& context) {
    alignas(64) int active[kPacket];
    fill_rays(packet.ray, active, rays);
    forget_hits(packet.hit);
    context.rays = rays.data();
    if (context.log != nullptr) write_down(packet.ray, active, false, context, *context.log);
    rtcIntersect16(active, context.embree_scene->top(), &context.embree, &packet);
}

void intersect_packets(std::span<const Ray> rays, std::span<Hit> hits, PacketContext context) {
    check(rays.size() == hits.size(), "intersect: one hit a ray");
    RTCRayHit16 packet;
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::span<const Ray> some = packet_at(rays, first);
        intersect_packet(packet, some, context);
        for (std::size_t i = 0; i < some.size(); ++i)
            hits[first + i] = make_hit(*context.embree_scene, packet, i, some[i]);
    }
}

}  // namespace

PacketContext make_context(const EmbreeScene& embree, const Scene& scene,
                           const CastSettings& settings) {
    PacketContext context;
    rtcInitIntersectContext(&context.embree);
    context.embree.flags = settings.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                             : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    // See-through meshes have the filter of their own; single-sided ones are nothing special to any
    // ray but the camera's.
    if (settings.camera && embree.any_single_sided()) context.embree.filter = see_through_filter;
    context.embree_scene = &embree;
    context.scene = &scene;
    context.kind = settings.kind;
    context.camera = settings.camera;
    return context;
}

RayCaster::RayCaster(const Scene& scene, int threads)
    : scene_(&scene), embree_(new Embree{EmbreeScene(scene, threads)}) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

void RayCaster::intersect(std::span<const Ray> rays, std::span<Hit> hits, RayKind kind) const {
    PacketContext context =
        make_context(embree_->scene, *scene_, {.camera = kind == RayKind::camera});
    context.log = log_;
    intersect_packets(rays, hits, context);
}

void RayCaster::intersect_coherent(std::span<const Ray> rays, std::span<Hit> hits,
                                   RayKind kind) const {
    PacketContext context = make_context(embree_->scene, *scene_,
                                         {.camera = kind == RayKind::camera, .coherent = true});
    context.log = log_;
    intersect_packets(rays, hits, context);
}

void RayCaster::transmittance(std::span<const Ray> rays, std::span<Rgb> through) const {
    check(rays.size() == through.size(), "transmittance: one answer a ray");
    PacketContext context = make_context(embree_->scene, *scene_, {.kind = FilterKind::through});
    std::array<SeamsMet, kPacket> seams;
    std::array<Rgb, kPacket> left;
    context.seams = seams.data();
    context.through = left.data();
    alignas(64) int active[kPacket];
    RTCRay16 packet;
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::span<const Ray> some = packet_at(rays, first);
        fill_rays(packet, active, some);
        for (SeamsMet& met : seams) met.count = 0;
        left.fill(Rgb(1));
        context.rays = some.data();
        if (log_ != nullptr) write_down(packet, active, true, context, *log_);
        rtcOccluded16(active, embree_->scene.top(), &context.embree, &packet);

        // Embree marks a blocked ray by an infinite negative end.
        for (std::size_t i = 0; i < some.size(); ++i)
            through[first + i] = packet.tfar[i] == -kInfinity ? Rgb(0) : left[i];
    }
}

void RayCaster::intersect_layers(std::span<const Ray> rays, std::vector<LayerHit>& found,
                                 RayKind kind) const {
    const bool camera = kind == RayKind::camera;
    PacketContext context =
        make_context(embree_->scene, *scene_,
                     {.kind = FilterKind::layers, .camera = camera, .coherent = camera});
    std::array<LayersMet, kPacket> layers;
    context.layers = layers.data();
    found.clear();
    RTCRayHit16 packet;
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::span<const Ray> some = packet_at(rays, first);
        for (LayersMet& met : layers) met.count = 0;
        intersect_packet(packet, some, context);
        for (std::size_t i = 0; i < some.size(); ++i) {
            const Hit last = make_hit(embree_->scene, packet, i, some[i]);
            const auto begin = layers[i].hits.begin(), end = begin + layers[i].count;
            std::sort(begin, end, nearer);
            const auto ray = static_cast<std::uint32_t>(first + i);
            for (auto layer = begin; layer != end && layer->t <= last.t; ++layer)
                found.push_back({ray, make_hit(embree_->scene, *layer, some[i])});
            if (last) found.push_back({ray, last});
        }
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

bool RayCaster::flat(const SurfacePoint& point) const {
    return embree_->scene.flat(point);
}

}  // namespace chiaro
