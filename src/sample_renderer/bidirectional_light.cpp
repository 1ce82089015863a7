#include "sample_renderer/bidirectional_light.h"

#include "sample_renderer/join.h"

#include <algorithm>

namespace chiaro {
namespace {

constexpr std::uint32_t kWave = 256;           // samples: their vertices stay in the cache
constexpr std::size_t kMostShadowRays = 4096;  // that wait, or little more
constexpr std::uint32_t kNone = 0xffff'ffff;
constexpr std::uint32_t kLightSalt = 0x119e7;

// What all steps of one wave share.
struct Wave {
    const LitScene& lit;
    const Emitters& emitters;
    const Sequence& sequence;
    std::uint32_t first, count;  // samples
    BidirectionalScratch& scratch;
    std::span<Rgb, kReplicates> sums;

    std::uint32_t slot(std::uint32_t sample) const { return (first + sample) % kReplicates; }
};

// One walk from a light for every sample; keeps what it meets.
void walk_from_lights(const Wave& w) {
    BidirectionalScratch& s = w.scratch;
    s.light_vertices.clear();
    s.newest.assign(w.count, kNone);
    s.emissions.resize(w.count);
    s.wave.clear();
    for (std::uint32_t i = 0; i < w.count && !w.emitters.empty(); ++i) {
        const std::uint32_t sample = w.first + i;
        const auto emission = w.emitters.sample(w.lit, w.sequence.number(sample, kFirstLightChoice),
                                                w.sequence.pair(sample, kFirstLightPlace),
                                                w.sequence.pair(sample, kEmission));
        if (!emission) continue;
        s.emissions[i] = *emission;
        Walk walk = walk_from_light(s.emissions[i]);
        walk.sample = i;
        walk.key = hash32(w.sequence.key(sample), kLightSalt);
        s.wave.add(emission->ray, walk);
    }
    s.wave.cast(w.lit.caster);
    const auto keep = [&](const WalkMeeting& met, BounceNumbers&) {
        if (is_delta_only(met.vertex.bsdf)) return;
        std::uint32_t& newest = s.newest[met.walk.sample];
        s.light_vertices.push_back({met.vertex, newest});
        newest = static_cast<std::uint32_t>(s.light_vertices.size() - 1);
    };
    follow_walks(w.lit, s.wave, keep, [](const Walk&, const Ray&) {});
}

void add(const Wave& w, const Join& found, std::uint32_t sample) {
    w.scratch.shadows.add({.shadow_ray = found.shadow_ray}, found.value * found.weight,
                          w.slot(sample));
}

// Joins a vertex from the eye to all that its sample's walk from a light met.
void join_walks(const Wave& w, const PathVertex& eye, std::uint32_t sample) {
    const BidirectionalScratch& s = w.scratch;
    for (std::uint32_t at = s.newest[sample]; at != kNone; at = s.light_vertices[at].previous)
        if (const auto found = join(eye, s.light_vertices[at].vertex)) add(w, *found, sample);
}

// Asks the lights on the vertex's own side, and those on the other if it lets light through.
void join_lights(const Wave& w, const PathVertex& eye, const Emitters::Numbers& numbers,
                 std::uint32_t sample) {
    const auto ask = [&](const Receiver& place) {
        w.emitters.sample_each_kind(w.lit, place, numbers, [&](const LightSample& light) {
            if (const auto found = join(eye, place, light)) add(w, *found, sample);
        });
    };
    ask(eye.place);
    const bool lit_through = eye.bsdf.glass > 0 && !eye.bsdf.smooth();
    if (lit_through) ask(other_side(eye.place));
}

// Where light samples were asked for that might have found what the walk's ray meets.
LitPlace start_of(const Walk& walk, const Ray& ray) {
    const bool below = glm::dot(walk.normal, ray.direction) < 0;
    return {ray.origin, below ? -walk.normal : walk.normal};
}

// Emission that a walk from the eye met by chance. On the first edge it is direct light.
void add_met_light(const Wave& w, const WalkMeeting& met) {
    const Rgb radiance = emission(w.lit.scene, met.hit.point, met.hit.front);
    if (met.walk.vertices == 1 || radiance == Rgb(0)) return;
    const MetLight light =
        w.emitters.met(w.lit, start_of(met.walk, met.ray), met.ray.direction, met.hit);
    w.sums[w.slot(met.walk.sample)] +=
        met.vertex.throughput * radiance * weight_of_met_light(met.vertex.trail, light);
}

void add_met_sky(const Wave& w, const Walk& walk, const Ray& ray) {
    if (walk.vertices == 1 || w.lit.environment.empty()) return;
    const MetLight light = w.emitters.met_sky(w.lit, start_of(walk, ray), ray.direction);
    w.sums[w.slot(walk.sample)] += walk.throughput * w.lit.environment.radiance(ray.direction) *
                                   weight_of_met_light(trail_at_sky(walk, ray.direction), light);
}

// Those of the first vertex are the sequence's.
Emitters::Numbers light_numbers(const Wave& w, const Walk& walk, BounceNumbers& numbers) {
    if (walk.steps > 0) return {numbers.next(), numbers.next_pair(), numbers.next_pair()};
    const std::uint32_t sample = w.first + walk.sample;
    return {w.sequence.number(sample, kFirstLightChoice), w.sequence.pair(sample, kFirstLightPlace),
            w.sequence.rotated_pair(sample, kFirstLightPlace, kFirstSkyRotation)};
}

void meet_from_eye(const Wave& w, const WalkMeeting& met, BounceNumbers& numbers) {
    if (met.surface.material.emissive()) add_met_light(w, met);
    if (is_delta_only(met.vertex.bsdf)) return;
    join_lights(w, met.vertex, light_numbers(w, met.walk, numbers), met.walk.sample);
    join_walks(w, met.vertex, met.walk.sample);
    if (w.scratch.shadows.rays.size() >= kMostShadowRays)
        w.scratch.shadows.settle(w.lit.caster, w.sums);
}

RayCount walk_from_point(const Wave& w, const OpenSides* open_sides, const Receiver& receiver) {
    BidirectionalScratch& s = w.scratch;
    const PathVertex end = eye_end(receiver);
    s.wave.clear();
    for (std::uint32_t i = 0; i < w.count; ++i) {
        join_walks(w, end, i);
        Ray ray;
        auto walk = walk_from_eye(end, w.sequence.pair(w.first + i, kFirstDirection), ray);
        if (!walk) continue;
        walk->sample = i;
        walk->key = w.sequence.key(w.first + i);
        s.wave.add(ray, *walk);
    }
    s.shadows.settle(w.lit.caster, w.sums);
    s.wave.cast(w.lit.caster);
    const RayCount rays = count_inside(open_sides, s.wave.hits);
    if (w.emitters.empty()) return rays;
    follow_walks(
        w.lit, s.wave,
        [&](const WalkMeeting& met, BounceNumbers& numbers) { meet_from_eye(w, met, numbers); },
        [&](const Walk& walk, const Ray& ray) { add_met_sky(w, walk, ray); });
    s.shadows.settle(w.lit.caster, w.sums);
    return rays;
}

}  // namespace

RayCount add_bidirectional_samples(const BidirectionalScene& scene, const SampleRun& run,
                                   BidirectionalScratch& scratch,
                                   std::span<Rgb, kReplicates> sums) {
    const Sequence sequence(run.seed);
    RayCount rays;
    for (std::uint32_t done = 0; done < run.count; done += kWave) {
        const Wave w = {scene.lit,
                        scene.emitters,
                        sequence,
                        run.first + done,
                        std::min(kWave, run.count - done),
                        scratch,
                        sums};
        walk_from_lights(w);
        const RayCount some = walk_from_point(w, scene.open_sides, run.receiver);
        rays.shot += some.shot;
        rays.inside += some.inside;
    }
    return rays;
}

}  // namespace chiaro
