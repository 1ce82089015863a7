#include "sample_renderer/path_vertex.h"

#include "sample_renderer/warp.h"

#include <cmath>

namespace chiaro {
namespace {

Scattering scattering_at(const PathVertex& v) {
    return make_scattering(v.bsdf, v.place.geometric_normal, v.place.shading_normal, v.from);
}

Rgb carried_by(const PathVertex& v, const Scattering& s, Vec3 to) {
    return v.transport == Transport::radiance ? scattered(s, to) : scattered_importance(s, to);
}

// A Lambertian surface, as scattering.h has it, at less work; `to` is above it.
Toward toward_diffusely(const PathVertex& v, Vec3 to) {
    const float cosine = receiving_cosine(v.place, to);
    const float cosine_back = receiving_cosine(v.place, v.from);
    Toward result;
    result.pdf = cosine * (1 / kPi);
    result.pdf_back = cosine_back * (1 / kPi);
    const Rgb value = v.bsdf.diffuse * (1 / kPi);
    if (v.transport == Transport::radiance) {
        result.carried = value * cosine;
        return result;
    }
    const float arriving = glm::dot(v.place.geometric_normal, v.from);
    const float leaving = glm::dot(v.place.geometric_normal, to);
    if (arriving > 0) result.carried = value * (cosine_back * leaving / arriving);
    return result;
}

// Whether a walk from the light along `sample`, a delta, would be led back to where this one came
// from: not where a direction was mirrored at the real plane, or counted as just above it.
bool leads_back(const Scattering& s, const BsdfSample& sample) {
    if (s.flat) return true;
    const Scattering light = reversed(s, sample.direction);
    if (!(glm::dot(light.frame.n, sample.direction) > 0)) return false;
    const bool passes = sample.lobe == Lobe::transmission;
    const Vec3 eye = passes ? split_smooth(light.bsdf, light.from).transmitted_from
                            : Vec3(-light.from.x, -light.from.y, light.from.z);
    constexpr float kRounding = 1e-3f;
    return glm::distance(light.frame.to_world(eye), s.from_world) < kRounding;
}

// A mirror takes a solid angle to as large a one; refraction keeps its projection times the squared
// index.
void set_delta_densities(const PathVertex& v, const Scattering& s, const BsdfSample& sample,
                         WalkStep& step) {
    step.pdf = step.pdf_back = 1;
    if (step.passes && !v.bsdf.thin) {
        step.pdf = std::abs(glm::dot(s.frame.n, step.direction)) * v.bsdf.eta * v.bsdf.eta;
        step.pdf_back = s.from.z;
    }
    if (v.transport == Transport::radiance && !leads_back(s, sample)) step.pdf_back = 0;
}

}  // namespace

PathVertex eye_end(const Receiver& receiver) {
    PathVertex end = {.place = receiver,
                      .from = receiver.geometric_normal,
                      .transport = Transport::radiance,
                      .throughput = Rgb(1)};
    end.bsdf.diffuse = Rgb(kPi);
    return end;
}

Toward toward(const PathVertex& v, Vec3 to) {
    if (is_lambertian(v.bsdf))
        return glm::dot(v.place.geometric_normal, to) > 0 ? toward_diffusely(v, to) : Toward{};
    const Scattering s = scattering_at(v);
    return {carried_by(v, s, to), pdf_scattering(s, to),
            pdf_scattering(reversed(s, to), s.from_world)};
}

std::optional<WalkStep> sample_step(const PathVertex& v, float u_lobe, Vec2 u) {
    WalkStep step = {};
    if (is_lambertian(v.bsdf)) {
        step.direction = sample_receiving_cosine(v.place, u);
        const Toward there = toward_diffusely(v, step.direction);
        if (!(there.pdf > 0)) return std::nullopt;
        step.weight = there.carried / there.pdf;
        step.pdf = there.pdf;
        step.pdf_back = there.pdf_back;
        return step;
    }
    const Scattering s = scattering_at(v);
    const auto sample = sample_scattering(s, u_lobe, u, v.transport);
    if (!sample) return std::nullopt;
    step.direction = sample->direction;
    step.weight = sample->weight;
    step.delta = sample->delta();
    step.passes = sample->lobe == Lobe::transmission;
    if (step.delta) {
        set_delta_densities(v, s, *sample, step);
        return step;
    }
    step.pdf = sample->pdf;
    step.pdf_back = pdf_scattering(reversed(s, step.direction), s.from_world);
    return step;
}

}  // namespace chiaro
