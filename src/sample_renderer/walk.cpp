#include "sample_renderer/walk.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr std::uint32_t kSureSteps = 8;

// What part of walks go on that a step takes from `before` to `after`. Radiance is dense in glass,
// which is no reason to end fewer walks in there.
float survival(const PathVertex& vertex, const WalkStep& step) {
    const bool bends = step.passes && !vertex.bsdf.thin && vertex.transport == Transport::radiance;
    const float index2 = bends ? vertex.bsdf.eta * vertex.bsdf.eta : 1.0f;
    const float left = max_component(vertex.throughput * step.weight);
    return std::min(kMostSurvival, index2 * left / max_component(vertex.throughput));
}

// Turns the walk into its next edge, or lets it go on along this one; false if it ends.
bool go_on(const PathVertex& vertex, const Hit& hit, BounceNumbers& numbers, Walk& walk, Ray& ray) {
    const float roulette = numbers.next(), lobe = numbers.next();
    const auto step = sample_step(vertex, lobe, numbers.next_pair());
    if (!step) return false;
    const bool sure = step->delta && walk.steps < kSureSteps;
    const float part = sure ? 1.0f : survival(vertex, *step);
    walk.throughput = vertex.throughput * step->weight;
    if (!(max_component(walk.throughput) > 0) || !(roulette < part)) return false;
    walk.throughput /= part;
    ++walk.steps;
    if (step->delta && step->passes && vertex.bsdf.thin) {
        pass_pane(hit, ray);
        return true;
    }
    walk.pdf = step->pdf;
    walk.trail = going_on(vertex.trail, step->pdf_back, step->delta);
    walk.position = vertex.place.position;
    walk.normal = vertex.place.geometric_normal;
    walk.parallel = false;
    walk.emission = nullptr;
    ++walk.vertices;
    ray = {origin_toward(vertex.place, step->direction), step->direction};
    return true;
}

}  // namespace

void WalkWave::clear() {
    rays.clear();
    walks.clear();
}

void WalkWave::add(const Ray& ray, const Walk& walk) {
    rays.push_back(ray);
    walks.push_back(walk);
}

void WalkWave::cast(const RayCaster& caster) {
    hits.resize(rays.size());
    caster.intersect(rays, hits);
}

PathVertex arrive(const LitScene& lit, const Walk& walk, const Ray& ray, const Hit& hit,
                  const MetSurface& surface) {
    PathVertex vertex = {.place = surface.receiver,
                         .from = -ray.direction,
                         .transport = walk.transport,
                         .throughput = walk.throughput,
                         .trail = walk.trail};
    if (surface.material.gloss.model == GlossModel::none)
        vertex.bsdf.diffuse = surface.base_color;
    else
        vertex.bsdf = bsdf_at(lit.scene, hit.point, hit.front);

    // From densities over solid angle to those over area; from infinity they are that already.
    constexpr float kLeast = 1e-30f;
    const Vec3 way = vertex.place.position - walk.position;
    const float squared = walk.parallel ? 1.0f : std::max(glm::dot(way, way), kLeast);
    const float cosine = std::abs(glm::dot(hit.normal, ray.direction));
    vertex.trail.density = std::max(walk.pdf * cosine / squared, kLeast);
    vertex.trail.to_before = std::abs(glm::dot(walk.normal, ray.direction)) / squared;

    // Where a light sample may have chosen the walk's start.
    if (walk.emission) {
        const float chosen = Emitters::chosen(lit, vertex.place, *walk.emission);
        vertex.trail.ends_before = heuristic(chosen / walk.emission->start);
    }
    return vertex;
}

Trail trail_at_sky(const Walk& walk, Vec3 direction) {
    Trail trail = walk.trail;
    trail.density = walk.pdf;
    trail.to_before = std::abs(glm::dot(walk.normal, direction));
    return trail;
}

void follow_walks(const LitScene& lit, WalkWave& wave, const MeetsVertex& meets,
                  const LeavesScene& leaves) {
    while (!wave.walks.empty()) {
        std::size_t alive = 0;
        for (std::size_t i = 0; i < wave.walks.size(); ++i) {
            const Hit& hit = wave.hits[i];
            Walk& walk = wave.walks[i];
            Ray& ray = wave.rays[i];
            if (!hit) {
                leaves(walk, ray);
                continue;
            }
            const MetSurface surface = describe(lit, hit);
            const PathVertex vertex = arrive(lit, walk, ray, hit, surface);
            BounceNumbers numbers(walk.key, walk.steps);
            meets({walk, ray, hit, surface, vertex}, numbers);
            if (!go_on(vertex, hit, numbers, walk, ray)) continue;
            wave.walks[alive] = walk;
            wave.rays[alive] = ray;
            ++alive;
        }
        wave.walks.resize(alive);
        wave.rays.resize(alive);
        wave.cast(lit.caster);
    }
}

std::optional<Walk> walk_from_eye(const PathVertex& end, Vec2 u, Ray& ray) {
    const auto step = sample_step(end, 0, u);
    if (!step) return std::nullopt;
    ray = {end.place.origin, step->direction};
    return Walk{.throughput = step->weight,
                .pdf = step->pdf,
                .trail = going_on(end.trail, step->pdf_back, false),
                .position = end.place.position,
                .normal = end.place.geometric_normal};
}

Walk walk_from_light(const Emission& emission) {
    Walk walk = {.throughput = emission.flux,
                 .pdf = emission.direction,
                 .position = emission.position,
                 .normal = emission.normal,
                 .parallel = emission.parallel(),
                 .transport = Transport::importance,
                 .emission = &emission};
    walk.trail.density_before = emission.start;
    walk.trail.ends_earlier = emission.solid() ? 1.0f : 0.0f;
    return walk;
}

}  // namespace chiaro
