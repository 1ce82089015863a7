#include "scene/scattering.h"

namespace chiaro {
namespace {

constexpr float kJustAbove = 1e-3f;

Vec3 mirrored(const Scattering& s, Vec3 w) {
    return w - 2 * glm::dot(s.geometric_normal, w) * s.geometric_normal;
}

// A direction of the frame, on that side of the real plane on which the frame has it.
Vec3 to_world(const Scattering& s, Vec3 local) {
    const Vec3 w = s.frame.to_world(local);
    if (s.flat || (glm::dot(s.geometric_normal, w) > 0) == (local.z > 0)) return w;
    return mirrored(s, w);
}

// Sums f over the directions of the frame that to_world() takes to `w`: one or two.
template <typename Function>
auto sum_over_locals(const Scattering& s, Vec3 w, const Function& f) {
    const Vec3 local = s.frame.to_local(w);
    if (s.flat) return f(local);
    const bool above = glm::dot(s.geometric_normal, w) > 0;
    decltype(f(local)) sum(0);
    for (const Vec3 l : {local, s.frame.to_local(mirrored(s, w))})
        if (l.z != 0 && (l.z > 0) == above) sum += f(l);
    return sum;
}

// A delta as eyes see it, for a walk that comes from the light: eyes lie where the shading normal
// has them, and see nothing where the two normals disagree about the side.
std::optional<BsdfSample> smooth_importance(const Scattering& s, BsdfSample sample) {
    const Vec3 local = sample.direction;
    sample.direction = s.frame.to_world(local);
    if (s.flat) return sample;
    const float arriving = glm::dot(s.geometric_normal, s.from_world);
    const float leaving = glm::dot(s.geometric_normal, sample.direction);
    const bool from_above = glm::dot(s.frame.n, s.from_world) > 0 && arriving > 0;
    if (!from_above || (leaving > 0) != (local.z > 0)) return std::nullopt;
    sample.weight *= std::abs(leaving * s.from.z / (arriving * local.z));
    return sample;
}

}  // namespace

Scattering make_scattering(const Bsdf& bsdf, Vec3 geometric_normal, Vec3 shading_normal,
                           Vec3 from) {
    const Frame frame(shading_normal);
    Vec3 local = frame.to_local(from);
    if (local.z < kJustAbove) local = glm::normalize(Vec3(local.x, local.y, kJustAbove));
    return {bsdf, frame, geometric_normal, local, from, geometric_normal == shading_normal};
}

Scattering reversed(const Scattering& s, Vec3 to) {
    if (glm::dot(s.geometric_normal, to) > 0)
        return make_scattering(s.bsdf, s.geometric_normal, s.frame.n, to);
    return make_scattering(turned(s.bsdf), -s.geometric_normal, -s.frame.n, to);
}

Rgb scattered(const Scattering& s, Vec3 to_light) {
    return sum_over_locals(s, to_light, [&](Vec3 local) {
        return eval_bsdf(s.bsdf, s.from, local) * std::abs(local.z);
    });
}

Rgb scattered_importance(const Scattering& s, Vec3 to_eye) {
    // Radiance counts light by the shading normal's cosine; flux arrives and leaves by the real
    // plane's.
    const float arriving = std::abs(glm::dot(s.geometric_normal, s.from_world));
    const float leaving = std::abs(glm::dot(s.geometric_normal, to_eye));
    if (!(arriving > 0 && leaving > 0)) return Rgb(0);
    return scattered(reversed(s, to_eye), s.from_world) * (leaving / arriving);
}

float pdf_scattering(const Scattering& s, Vec3 to) {
    return sum_over_locals(s, to, [&](Vec3 local) { return pdf_bsdf(s.bsdf, s.from, local); });
}

std::optional<BsdfSample> sample_scattering(const Scattering& s, float u_lobe, Vec2 u,
                                            Transport transport) {
    const bool to_light = transport == Transport::radiance;
    auto sample = sample_bsdf(s.bsdf, s.from, u_lobe, u, transport);
    if (!sample) return std::nullopt;
    if (sample->delta() && !to_light) return smooth_importance(s, *sample);
    sample->direction = to_world(s, sample->direction);
    if (s.flat || sample->delta()) return sample;
    // Two directions of the frame may lead here.
    sample->pdf = pdf_scattering(s, sample->direction);
    if (!(sample->pdf > 0)) return std::nullopt;
    const Rgb value =
        to_light ? scattered(s, sample->direction) : scattered_importance(s, sample->direction);
    sample->weight = value / sample->pdf;
    return sample;
}

SmoothParts smooth_parts(const Scattering& s) {
    const SmoothSplit split = split_smooth(s.bsdf, s.from);
    SmoothParts parts;
    parts.reflected = split.reflected;
    parts.reflected_from = to_world(s, {-s.from.x, -s.from.y, s.from.z});
    parts.transmitted = split.transmitted;
    parts.transmitted_from = to_world(s, split.transmitted_from);
    return parts;
}

}  // namespace chiaro
