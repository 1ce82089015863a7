// Surface points that receive light, one by one and in eights.
#pragma once

#include "rays/ray_caster.h"
#include "sample_renderer/warp.h"
#include "scene/light_clusters.h"

namespace chiaro {

/// A surface point from the side that light arrives on.
struct Receiver {
    Vec3 position;          // on the surface
    Vec3 origin;            // lifted off it: where rays start
    Vec3 geometric_normal;  // both unit, on the receiving side
    Vec3 shading_normal;
};
Receiver make_receiver(const RayCaster& caster, ObjectId object, Vec3 position,
                       Vec3 geometric_normal, Vec3 shading_normal);

/// Eight receivers.
struct Receiver8 {
    Vec3x8 position, origin, geometric_normal, shading_normal;
};
inline Receiver8 everywhere(const Receiver& r) {
    return {everywhere(r.position), everywhere(r.origin), everywhere(r.geometric_normal),
            everywhere(r.shading_normal)};
}

Receiver lane(const Receiver8& receivers, int i);

/// The same place, receiving on its other side.
inline Receiver other_side(const Receiver& r) {
    return {r.position, 2.0f * r.position - r.origin, -r.geometric_normal, -r.shading_normal};
}

/// What lights are chosen for: rays start at the lifted origin, and nothing below the real plane
/// counts.
inline LitPlace lit_place(const Receiver& receiver) {
    return {receiver.origin, receiver.geometric_normal};
}

/// `w` mirrored at the receiver's real plane.
inline Vec3 mirrored(const Receiver& receiver, Vec3 w) {
    return w - 2 * glm::dot(receiver.geometric_normal, w) * receiver.geometric_normal;
}

/// What light from unit direction `w` counts for in irradiance: the cosine about the shading
/// normal. The part of its hemisphere that lies below the real plane is folded up, so that the
/// whole is pi on any surface and no light is lost where normals are interpolated; 0 below that
/// plane. For Receiver and Receiver8.
template <typename AnyReceiver, typename Vector>
auto receiving_cosine(const AnyReceiver& receiver, const Vector& w) {
    using Number = std::remove_cvref_t<decltype(w.x)>;
    const Number zero(0);
    const Number above = dot(receiver.geometric_normal, w);
    const Number cosine = dot(receiver.shading_normal, w);
    const Number of_mirrored =
        cosine - Number(2) * above * dot(receiver.geometric_normal, receiver.shading_normal);
    return select(above > zero, larger(zero, cosine) + larger(zero, of_mirrored), zero);
}

/// A direction of density receiving_cosine() / pi over solid angle; `u` in [0, 1)^2.
Vec3 sample_receiving_cosine(const Receiver& receiver, Vec2 u);
Vec3x8 sample_receiving_cosine(const Receiver8& receiver, const Vec2x8& u);
float pdf_receiving_cosine(const Receiver& receiver, Vec3 w);

}  // namespace chiaro
