#include "rays/filter.h"

#include "base/random.h"
#include "scene/bsdf.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace chiaro {
namespace {

constexpr float kSeamWidth = 1e-4f;  // in (u, v)
constexpr float kSamePlace = 1e-5f;  // of the distance along the ray

bool double_sided(const Scene& scene, const SurfacePoint& point) {
    return scene.material(material_of(scene, point)).double_sided;
}

// The whole ray decides, in world space: the same ray meets the same layers on every run, wherever
// its packet is and whatever order Embree asks in, and rays of one fan decide independently.
float ray_number(const Ray& ray, std::uint32_t object, std::uint32_t primitive) {
    std::uint32_t h = hash32(object, primitive);
    for (const Vec3& v : {ray.origin, ray.direction})
        for (int axis = 0; axis < 3; ++axis) h = hash32(h, std::bit_cast<std::uint32_t>(v[axis]));
    return to_unit_float(h);
}

RawHit hit_of(const RTCFilterFunctionNArguments* arguments, unsigned i) {
    const unsigned n = arguments->N;
    RTCHitN* const hit = arguments->hit;
    return {RTCHitN_instID(hit, n, i, 0),
            RTCHitN_geomID(hit, n, i),
            RTCHitN_primID(hit, n, i),
            RTCHitN_u(hit, n, i),
            RTCHitN_v(hit, n, i),
            RTCRayN_tfar(arguments->ray, n, i),
            {RTCHitN_Ng_x(hit, n, i), RTCHitN_Ng_y(hit, n, i), RTCHitN_Ng_z(hit, n, i)}};
}

bool on_seam(const PacketContext& context, const RawHit& hit) {
    const auto [u, v] = context.embree_scene->place_in_cell(hit, context.camera);
    const float beyond =
        hit.is_triangle() ? 1 - u - v : std::min({1 - u, 1 - v, std::abs(1 - u - v)});
    return std::min({u, v, beyond}) < kSeamWidth;
}

bool same_place(float t, float other) {
    return std::abs(t - other) <= kSamePlace * t;
}

// Whether a neighbour's side of the same seam was told of before; if not, notes this one.
bool met_before(SeamsMet& seams, const RawHit& hit) {
    const std::uint32_t known = std::min(seams.count, SeamsMet::kMost);
    for (std::uint32_t i = 0; i < known; ++i)
        if (seams.objects[i] == hit.object && same_place(hit.t, seams.t[i])) return true;
    const std::uint32_t place = seams.count++ % SeamsMet::kMost;
    seams.objects[place] = hit.object;
    seams.t[place] = hit.t;
    return false;
}

bool met_before(const PacketContext& context, const LayersMet& layers, const RawHit& hit) {
    const auto end = layers.hits.begin() + layers.count;
    return std::any_of(layers.hits.begin(), end, [&](const RawHit& other) {
        return other.object == hit.object && same_place(hit.t, other.t) && on_seam(context, other);
    });
}

// Where there is no room, the farthest gives way.
void add_layer(LayersMet& layers, const RawHit& hit) {
    if (layers.count < kMostLayers) {
        layers.hits[layers.count++] = hit;
        return;
    }
    const auto nearer = [](const RawHit& a, const RawHit& b) { return a.t < b.t; };
    RawHit& farthest = *std::max_element(layers.hits.begin(), layers.hits.end(), nearer);
    if (hit.t < farthest.t) farthest = hit;
}

// What a smooth pane lets through; black of all else.
Rgb straight_on(const PacketContext& context, const RawHit& hit, const SurfacePoint& point,
                Vec3 direction) {
    const Scene& scene = *context.scene;
    if (!may_pass_straight(scene.material(material_of(scene, point)))) return Rgb(0);
    const EmbreeScene& embree = *context.embree_scene;
    Vec3 normal = embree.normal_of(hit);
    if (!embree.flat(embree.instance(hit.object), point.primitive))
        normal = shading_normal(scene, point, normal);
    const float cosine = glm::dot(normal, direction) / glm::length(direction);
    return straight_transmittance(bsdf_at(scene, point, true), cosine);
}

// True if the ray in `lane` goes on.
bool passes(const PacketContext& context, const RawHit& hit, std::uint32_t lane) {
    const Ray& ray = context.rays[lane];
    const SurfacePoint point = context.embree_scene->point_of(hit);
    if (context.camera && !double_sided(*context.scene, point) &&
        !(glm::dot(context.embree_scene->normal_of(hit), ray.direction) < 0))
        return true;

    const float alpha = opacity(*context.scene, point);
    if (alpha <= 0) return true;
    if (context.kind == FilterKind::through) {
        const Rgb left = (1 - alpha) + alpha * straight_on(context, hit, point, ray.direction);
        if (!(max_component(left) > 0)) return false;
        if (!on_seam(context, hit) || !met_before(context.seams[lane], hit))
            context.through[lane] *= left;
        return true;
    }
    if (alpha >= 1) return false;
    if (context.kind == FilterKind::chance)
        return ray_number(ray, hit.object, point.primitive) >= alpha;
    if (!on_seam(context, hit) || !met_before(context, context.layers[lane], hit))
        add_layer(context.layers[lane], hit);
    return true;
}

}  // namespace

void see_through_filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const PacketContext*>(arguments->context);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const std::uint32_t lane = RTCRayN_id(arguments->ray, n, i);
        if (passes(context, hit_of(arguments, i), lane)) arguments->valid[i] = 0;
    }
}

}  // namespace chiaro
