#include "rays/ray_caster.h"

#include "base/error.h"
#include "rays/packet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace chiaro {
namespace {

std::span<const Ray> packet_at(std::span<const Ray> rays, std::size_t first) {
    return rays.subspan(first, std::min(kPacket, rays.size() - first));
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
    const EmbreeScene& embree = *context.embree_scene;
    rtcIntersect16(active, context.camera ? embree.eye() : embree.top(), &context.embree, &packet);
}

void intersect_packets(std::span<const Ray> rays, std::span<Hit> hits, PacketContext context) {
    check(rays.size() == hits.size(), "intersect: one hit a ray");
    RTCRayHit16 packet;
    fill_constant_rows(packet.ray);
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::span<const Ray> some = packet_at(rays, first);
        intersect_packet(packet, some, context);
        make_hits(*context.embree_scene, packet, hits.subspan(first, some.size()));
    }
}

}  // namespace

RayCaster::RayCaster(const Scene& scene, int threads, float curve_tolerance)
    : scene_(&scene), embree_(new Embree{EmbreeScene(scene, threads, curve_tolerance)}) {}
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
    fill_constant_rows(packet);
    left.fill(Rgb(1));
    const bool filtered = embree_->scene.any_filter();
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::span<const Ray> some = packet_at(rays, first);
        fill_rays(packet, active, some);
        if (filtered) {
            for (SeamsMet& met : seams) met.count = 0;
            left.fill(Rgb(1));
        }
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
    std::array<Hit, kPacket> last_hits;
    context.layers = layers.data();
    found.clear();
    RTCRayHit16 packet;
    fill_constant_rows(packet.ray);
    for (std::size_t first = 0; first < rays.size(); first += kPacket) {
        const std::span<const Ray> some = packet_at(rays, first);
        for (LayersMet& met : layers) met.count = 0;
        intersect_packet(packet, some, context);
        make_hits(embree_->scene, packet, std::span(last_hits).first(some.size()));
        for (std::size_t i = 0; i < some.size(); ++i) {
            const Hit& last = last_hits[i];
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

void RayCaster::set_shown(ObjectId object) {
    embree_->scene.set_shown(*scene_, object);
}

void RayCaster::add_objects() {
    embree_->scene.add_objects(*scene_);
}

void RayCaster::set_material(MaterialId material) {
    check(index_of(material) < scene_->materials.size(), "set_material: unknown material");
    embree_->scene.set_material(*scene_, material);
}

void RayCaster::show_curves(std::vector<ShownCurves> curves) {
    embree_->scene.show_curves(*scene_, std::move(curves));
}

float RayCaster::curve_tolerance(MeshId mesh) const {
    return embree_->scene.curve_tolerance(mesh);
}

float RayCaster::offset(Vec3 position) {
    return offset_at(position, 0.0f);
}

float RayCaster::offset(Vec3 position, ObjectId object) const {
    const auto id = static_cast<std::uint32_t>(object);
    return offset_at(position, embree_->scene.extent(id)) + embree_->scene.curve_error(id);
}

}  // namespace chiaro
