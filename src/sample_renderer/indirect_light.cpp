#include "sample_renderer/indirect_light.h"

#include "sample_renderer/warp.h"

namespace chiaro {
namespace {

Ray first_ray(const Receiver& receiver, const Sequence& sequence, std::uint32_t sample) {
    return {receiver.origin,
            sample_receiving_cosine(receiver, sequence.pair(sample, kFirstDirection))};
}

// One cosine-distributed ray a sample. Cosine over density is pi, which the throughput leaves out.
void start_paths(const Receiver& receiver, std::uint32_t seed, std::uint32_t first,
                 std::uint32_t count, PathWave& wave) {
    const Sequence sequence(seed);
    wave.clear();
    for (std::uint32_t i = first; i < first + count; ++i)
        wave.add(first_ray(receiver, sequence, i), make_path(sequence, i, i % kReplicates));
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

RayCount add_indirect_samples(const LitScene& lit, const Receiver& receiver, std::uint32_t seed,
                              std::uint32_t first, std::uint32_t count, PathWave& scratch,
                              std::span<Rgb, kReplicates> sums, const IndirectOptions& options) {
    thread_local std::vector<SurfacePoint> targets;
    start_paths(receiver, seed, first, count, scratch);
    if (options.aims) add_aimed_rays(*options.aims, receiver, seed, first, count, scratch, targets);
    scratch.hits.resize(scratch.rays.size());
    lit.caster.intersect(scratch.rays, scratch.hits);
    const RayCount rays = count_inside(options.open_sides, std::span(scratch.hits).first(count));
    if (options.aims) weigh_aimed_rays(*options.aims, receiver, targets, scratch);

    std::array<Rgb, kReplicates> radiance = {};
    follow(lit, scratch, FirstEmission::skipped, radiance, options.ends_at);
    for (std::uint32_t r = 0; r < kReplicates; ++r) sums[r] += kPi * radiance[r];
    return rays;
}

RayCount probe(const LitScene& lit, const OpenSides& open_sides, const Receiver& receiver,
               std::uint32_t seed, std::uint32_t count, PathWave& scratch) {
    const Sequence sequence(seed);
    scratch.clear();
    for (std::uint32_t i = 0; i < count; ++i)
        scratch.rays.push_back(first_ray(receiver, sequence, i));
    scratch.hits.resize(count);
    lit.caster.intersect(scratch.rays, scratch.hits);
    return count_inside(&open_sides, scratch.hits);
}

}  // namespace chiaro
