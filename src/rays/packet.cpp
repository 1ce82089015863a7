#include "rays/packet.h"

#include "base/error.h"
#include "base/vec8.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr float kFarthest = 1e18f;  // Embree refuses coordinates above 1.8e18

// Where a row of a packet holds eight lanes.
Float8 part(const float* row, std::size_t first) {
    return load8(row + first);
}
Vec3x8 part(const float* x, const float* y, const float* z, std::size_t first) {
    return {part(x, first), part(y, first), part(z, first)};
}

// A hit is as exact as the far ends of its ray and of its object are.
template <typename Vector, typename Number>
Number offset_of_hit(const Vector& origin, const Vector& direction, Number t, Number extent) {
    return offset_at(origin + t * direction, extent + largest(origin));
}

// What hits need of the objects that they are on; of a lane without one, the first object's.
struct ObjectsMet {
    alignas(32) float normal_x[kLanes], normal_y[kLanes], normal_z[kLanes], extent[kLanes];
    alignas(32) float curve_error[kLanes];
};

void look_up(const EmbreeScene& scene, const RTCHit16& found, std::size_t lane, std::size_t to,
             ObjectsMet& met, Hit& hit) {
    const std::uint32_t object = found.instID[0][lane];
    const EmbreeScene::Instance& instance = scene.instance(object);
    const Vec3 normal =
        instance.normal_matrix * Vec3(found.Ng_x[lane], found.Ng_y[lane], found.Ng_z[lane]);
    met.normal_x[to] = normal.x;
    met.normal_y[to] = normal.y;
    met.normal_z[to] = normal.z;
    met.extent[to] = instance.extent;
    met.curve_error[to] = found.geomID[lane] == kBicubics ? instance.curve_error : 0;
    hit.point.object = static_cast<ObjectId>(object);
    hit.point.primitive = instance.first_of[found.geomID[lane]] + found.primID[lane];
    hit.flat = scene.flat(instance, hit.point.primitive);
    // Whoever shades asks for its material next, and it is far away in large scenes.
    _mm_prefetch(reinterpret_cast<const char*>(instance.primitives + hit.point.primitive),
                 _MM_HINT_T0);
}

// The hits of lanes [first, first + hits.size()), at most eight.
void make_eight_hits(const EmbreeScene& scene, const RTCRayHit16& packet, std::size_t first,
                     std::span<Hit> hits) {
    ObjectsMet met = {};
    for (std::size_t i = 0; i < hits.size(); ++i) {
        hits[i] = {};
        if (packet.hit.geomID[first + i] != RTC_INVALID_GEOMETRY_ID)
            look_up(scene, packet.hit, first + i, i, met, hits[i]);
    }

    const Vec3x8 direction = part(packet.ray.dir_x, packet.ray.dir_y, packet.ray.dir_z, first);
    const Vec3x8 origin = part(packet.ray.org_x, packet.ray.org_y, packet.ray.org_z, first);
    const Float8 t = part(packet.ray.tfar, first);
    const Vec3x8 normal = part(met.normal_x, met.normal_y, met.normal_z, 0);
    const Float8 squared = dot(normal, normal);
    const unsigned trusted = ((squared > Float8(1e-30f)) & (squared < Float8(1e30f))).lanes();
    const Vec3x8 unit = (Float8(1) / sqrt(squared)) * normal;
    const unsigned front = (dot(unit, direction) < Float8(0)).lanes();
    const Float8 offset =
        offset_of_hit(origin, direction, t, part(met.extent, 0)) + part(met.curve_error, 0);

    alignas(32) float rows[4][kLanes];
    unit.x.store(rows[0]);
    unit.y.store(rows[1]);
    unit.z.store(rows[2]);
    offset.store(rows[3]);
    alignas(32) float u[kLanes], v[kLanes];
    const auto in_unit = [](Float8 x) { return smaller(larger(x, Float8(0)), Float8(1)); };
    in_unit(part(packet.hit.u, first)).store(u);
    in_unit(part(packet.hit.v, first)).store(v);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        Hit& hit = hits[i];
        if (!hit) continue;
        hit.point.u = u[i];
        hit.point.v = v[i];
        hit.t = packet.ray.tfar[first + i];
        hit.normal = {rows[0][i], rows[1][i], rows[2][i]};
        hit.offset = rows[3][i];
        hit.front = (front >> i & 1) != 0;
        if ((trusted >> i & 1) != 0) continue;
        const Vec3 ray(packet.ray.dir_x[first + i], packet.ray.dir_y[first + i],
                       packet.ray.dir_z[first + i]);
        hit.normal =
            safe_normalize({met.normal_x[i], met.normal_y[i], met.normal_z[i]}, Vec3(0, 0, 1));
        hit.front = glm::dot(hit.normal, ray) < 0;
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

// One transposition for eight rays. Embree's asserts would end the process, even for a lane that is
// off. One comparison tells of six numbers: a sum is not below the bound if any term is large,
// infinite or a NaN.
void fill_rays(RTCRay16& packet, int* active, std::span<const Ray> rays) {
    static_assert(sizeof(Ray) == kLanes * sizeof(float));
    unsigned sound = 0xff;
    for (std::size_t first = 0; first < kPacket; first += kLanes) {
        Float8 rows[kLanes];
        for (std::size_t i = 0; i < kLanes; ++i)
            rows[i] = load8(&rays[first + i < rays.size() ? first + i : 0].origin.x);
        transpose(rows);
        const auto& [x, y, z, dx, dy, dz, t_min, t_max] = rows;
        const Mask8 filled = first_lanes(rays.size() - std::min(first, rays.size()));
        const Mask8 on = filled & (t_min <= t_max);
        const Float8 end = select(filled & (t_min > t_max), Float8(-1), t_max);
        x.store(packet.org_x + first);
        y.store(packet.org_y + first);
        z.store(packet.org_z + first);
        dx.store(packet.dir_x + first);
        dy.store(packet.dir_y + first);
        dz.store(packet.dir_z + first);
        t_min.store(packet.tnear + first);
        select(filled, end, Float8(-1)).store(packet.tfar + first);
        Float8(on.bits).store(reinterpret_cast<float*>(active + first));
        const Float8 sum = abs(x) + abs(y) + abs(z) + abs(dx) + abs(dy) + abs(dz);
        const Mask8 in_order = (Float8(0) <= t_min) & (Float8(-1) <= end);
        sound &= ((sum < Float8(kFarthest)) & in_order).lanes();
    }
    check(sound == 0xff, "RayCaster: a ray is not finite");
}

Hit make_hit(const EmbreeScene& scene, const RawHit& raw, const Ray& ray) {
    Hit hit;
    hit.point = scene.point_of(raw);
    hit.t = raw.t;
    hit.normal = scene.normal_of(raw);
    hit.front = glm::dot(hit.normal, ray.direction) < 0;
    hit.flat = scene.flat(scene.instance(raw.object), hit.point.primitive);
    hit.offset = offset_of_hit(ray.origin, ray.direction, raw.t, scene.extent(raw.object));
    if (raw.geometry == kBicubics) hit.offset += scene.curve_error(raw.object);
    return hit;
}

void make_hits(const EmbreeScene& scene, const RTCRayHit16& packet, std::span<Hit> hits) {
    for (std::size_t first = 0; first < hits.size(); first += kLanes)
        make_eight_hits(scene, packet, first,
                        hits.subspan(first, std::min<std::size_t>(kLanes, hits.size() - first)));
}

}  // namespace chiaro
