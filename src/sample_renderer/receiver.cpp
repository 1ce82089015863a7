#include "sample_renderer/receiver.h"

namespace chiaro {

Receiver make_receiver(const RayCaster& caster, ObjectId object, Vec3 position,
                       Vec3 geometric_normal, Vec3 shading_normal) {
    const float lift = caster.offset(position, object);
    return {position, position + lift * geometric_normal, geometric_normal, shading_normal};
}

Receiver lane(const Receiver8& receivers, int i) {
    return {Lanes3(receivers.position).lane(i), Lanes3(receivers.origin).lane(i),
            Lanes3(receivers.geometric_normal).lane(i), Lanes3(receivers.shading_normal).lane(i)};
}

Vec3 sample_receiving_cosine(const Receiver& receiver, Vec2 u) {
    const Vec3 w = from_frame(receiver.shading_normal, square_to_cosine_hemisphere(u));
    return glm::dot(receiver.geometric_normal, w) > 0 ? w : mirrored(receiver, w);
}

Vec3x8 sample_receiving_cosine(const Receiver8& receiver, const Vec2x8& u) {
    const Vec3x8 w = from_frame(receiver.shading_normal, square_to_cosine_hemisphere(u));
    const Float8 above = dot(receiver.geometric_normal, w);
    return w + larger(Float8(0), Float8(-2) * above) * receiver.geometric_normal;
}

float pdf_receiving_cosine(const Receiver& receiver, Vec3 w) {
    return receiving_cosine(receiver, w) * (1 / kPi);
}

}  // namespace chiaro
