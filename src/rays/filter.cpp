#include "rays/filter.h"

#include "base/random.h"
#include "rays/embree_scene.h"

#include <bit>

namespace chiaro {
namespace {

// The whole ray decides, in world space: the same ray meets the same layers on every run, wherever
// its packet is and whatever order Embree asks in, and rays of one fan decide independently.
float ray_number(const Ray& ray, std::uint32_t object, std::uint32_t primitive) {
    std::uint32_t h = hash32(object, primitive);
    for (const Vec3& v : {ray.origin, ray.direction})
        for (int axis = 0; axis < 3; ++axis) h = hash32(h, std::bit_cast<std::uint32_t>(v[axis]));
    return to_unit_float(h);
}

bool stops(const CastContext& context, const Scene& scene, const SurfacePoint& point,
           std::uint32_t lane) {
    const Mesh& mesh = scene.mesh_of(scene.objects[index_of(point.object)]);
    const Material& material = scene.material(mesh.primitives[point.primitive].material);
    if (material.alpha_mode == AlphaMode::opaque) return true;
    const float alpha = base_color(scene, point).a;
    if (material.alpha_mode == AlphaMode::mask) return alpha >= material.alpha_cutoff;
    if (context.kind == RayKind::layers) return alpha > 0;
    const auto object = static_cast<std::uint32_t>(point.object);
    return ray_number(context.rays[lane], object, point.primitive) < alpha;
}

}  // namespace

void see_through_filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& context = *reinterpret_cast<const CastContext*>(arguments->context);
    const auto& data = *static_cast<const FilterData*>(arguments->geometryUserPtr);
    const unsigned n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (arguments->valid[i] == 0) continue;
        const SurfacePoint point = {static_cast<ObjectId>(RTCHitN_instID(arguments->hit, n, i, 0)),
                                    data.first_primitive + RTCHitN_primID(arguments->hit, n, i),
                                    RTCHitN_u(arguments->hit, n, i),
                                    RTCHitN_v(arguments->hit, n, i)};
        const std::uint32_t lane = RTCRayN_id(arguments->ray, n, i);
        if (!stops(context, *data.scene, point, lane)) arguments->valid[i] = 0;
    }
}

}  // namespace chiaro
