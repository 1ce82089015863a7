#include "sample_renderer/indirect_light.h"

#include <algorithm>

namespace chiaro {
namespace {

// The first rays of samples [first, first + kLanes).
void first_rays(const Receiver& receiver, const Sequence& sequence, std::uint32_t first,
                Ray (&rays)[kLanes]) {
    alignas(32) float x[kLanes], y[kLanes];
    for (std::uint32_t i = 0; i < kLanes; ++i) {
        const Vec2 u = sequence.pair(first + i, kFirstDirection);
        x[i] = u.x;
        y[i] = u.y;
    }
    const Vec3x8 direction = sample_receiving_cosine(everywhere(receiver), {load8(x), load8(y)});
    const Vec3x8 origin = everywhere(receiver.origin);
    Float8 words[kLanes] = {origin.x,    origin.y,    origin.z, direction.x,
                            direction.y, direction.z, 0.0f,     kInfinity};
    store_words(words, rays);
}

// Calls each(sample, ray).
template <typename Each>
void for_each_first_ray(const Receiver& receiver, const Sequence& sequence, std::uint32_t first,
                        std::uint32_t count, const Each& each) {
    Ray rays[kLanes];
    for (std::uint32_t done = 0; done < count; done += kLanes) {
        first_rays(receiver, sequence, first + done, rays);
        for (std::uint32_t i = 0; i < std::min<std::uint32_t>(kLanes, count - done); ++i)
            each(first + done + i, rays[i]);
    }
}

// One cosine-distributed ray a sample. Cosine over density is pi, which the throughput leaves out.
void start_paths(std::span<const SampleRun> runs, PathWave& wave) {
    wave.clear();
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const auto& [receiver, seed, first, count] = runs[r];
        const Sequence sequence(seed);
        for_each_first_ray(receiver, sequence, first, count, [&](std::uint32_t i, const Ray& ray) {
            wave.add(ray, make_path(sequence, i, slot_of(r, i)));
        });
    }
}

}  // namespace

RayCount count_inside(const OpenSides* open_sides, std::span<const Hit> hits) {
    RayCount count;
    if (!open_sides) return count;
    for (const Hit& hit : hits) {
        ++count.shot;
        if (hit && open_sides->is_inside(hit.point.object, hit.point.primitive, hit.front))
            ++count.inside;
    }
    return count;
}

RayCount add_indirect_samples(const LitScene& lit, std::span<const SampleRun> runs,
                              PathWave& scratch, std::span<Rgb> sums,
                              const IndirectOptions& options) {
    thread_local std::vector<Target> targets;
    thread_local std::vector<Rgb> radiance;
    start_paths(runs, scratch);
    const std::size_t by_cosine = scratch.rays.size();
    if (options.aims) add_aimed_rays(*options.aims, runs, scratch, targets);
    scratch.hits.resize(scratch.rays.size());
    lit.caster.intersect(scratch.rays, scratch.hits);
    const RayCount rays =
        count_inside(options.open_sides, std::span(scratch.hits).first(by_cosine));
    if (options.aims) weigh_aimed_rays(*options.aims, runs, targets, scratch);

    radiance.assign(sums.size(), Rgb(0));
    follow(lit, scratch, FirstEmission::skipped, radiance, options.ends_at);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += kPi * radiance[i];
    return rays;
}

RayCount probe(const LitScene& lit, const OpenSides& open_sides, const Receiver& receiver,
               std::uint32_t seed, std::uint32_t count, PathWave& scratch) {
    const Sequence sequence(seed);
    scratch.clear();
    for_each_first_ray(receiver, sequence, 0, count,
                       [&](std::uint32_t, const Ray& ray) { scratch.rays.push_back(ray); });
    scratch.hits.resize(count);
    lit.caster.intersect(scratch.rays, scratch.hits);
    return count_inside(&open_sides, scratch.hits);
}

}  // namespace chiaro
