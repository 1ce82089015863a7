#include "sample_renderer/aimed_rays.h"

namespace chiaro {
namespace {

constexpr std::uint32_t kAimedSalt = 0xa13ed;

// Density over solid angle with which aimed rays meet the hit.
float pdf_aimed(const SampledSurfaces& surfaces, const LitPlace& place, Vec3 direction,
                const Hit& hit) {
    const float cosine = std::abs(glm::dot(hit.normal, direction));
    if (!(cosine > 0)) return 0;
    return surfaces.pdf(place, hit.point) * hit.t * hit.t / cosine;
}

void add_aimed_ray(const Aims& aims, const Receiver& receiver, const Sequence& sequence,
                   std::uint32_t sample, std::uint32_t slot, PathWave& wave,
                   std::vector<Target>& targets) {
    const std::uint32_t replicate = sample % kReplicates, index = sample / kReplicates;
    const auto found =
        aims.surfaces.sample(lit_place(receiver), sequence.number(sample, kFirstLightChoice),
                             sequence.sparse_pair(replicate, index / aims.every, kFirstLightPlace));
    if (!found) return;
    const Vec3 between = found->position - receiver.origin;
    const float squared = glm::dot(between, between);
    if (!(squared > 0)) return;
    const Vec3 direction = between / std::sqrt(squared);
    if (!(receiving_cosine(receiver, direction) > 0)) return;
    // The numbers that chose the target choose nothing at it: one number for two factors of a
    // product would see but the diagonal of their square.
    Path path = make_path(sequence, sample, slot);
    path.key = hash32(path.key, kAimedSalt);
    path.light_choice = BounceNumbers(path.key, kAimedSalt).next();
    path.light_place = path.sky_place;
    path.first = Path::kAimedFirst;
    wave.add({receiver.origin, direction}, path);
    targets.push_back({found->point, std::sqrt(squared)});
}

// A quad that is bent may hide its own far half.
bool is_reached(const Target& target, const Hit& hit) {
    return hit.point.object == target.point.object &&
           hit.point.primitive == target.point.primitive && hit.t > 0.9999f * target.distance;
}

}  // namespace

void add_aimed_rays(const Aims& aims, std::span<const SampleRun> runs, PathWave& wave,
                    std::vector<Target>& targets) {
    targets.clear();
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const auto& [receiver, seed, first, count] = runs[r];
        const Sequence sequence(seed);
        for (std::uint32_t i = first; i < first + count; ++i)
            if (takes_turn(seed, i % kReplicates, i / kReplicates, aims.every))
                add_aimed_ray(aims, receiver, sequence, i, slot_of(r, i), wave, targets);
    }
}

void weigh_aimed_rays(const Aims& aims, std::span<const SampleRun> runs,
                      std::span<const Target> targets, PathWave& wave) {
    const std::size_t by_cosine = wave.paths.size() - targets.size();
    std::size_t left = 0;
    for (std::size_t i = 0; i < wave.paths.size(); ++i) {
        const Hit& hit = wave.hits[i];
        if (!hit) continue;
        if (i >= by_cosine && !is_reached(targets[i - by_cosine], hit)) continue;
        const Receiver& receiver = run_of(runs, wave.paths[i].slot).receiver;
        // The throughput of either kind is the cosine / pi over the sum of the densities.
        const Vec3 direction = wave.rays[i].direction;
        const float pdf = pdf_receiving_cosine(receiver, direction);
        const float aimed = pdf_aimed(aims.surfaces, lit_place(receiver), direction, hit) /
                            static_cast<float>(aims.every);
        const float weight = pdf / (pdf + aimed);
        wave.paths[i].throughput = Rgb(weight);
        if (i >= by_cosine) wave.paths[i].roulette_scale = 1 / weight;
        wave.paths[left] = wave.paths[i];
        wave.rays[left] = wave.rays[i];
        wave.hits[left++] = hit;
    }
    wave.paths.resize(left);
    wave.rays.resize(left);
    wave.hits.resize(left);
}

}  // namespace chiaro
