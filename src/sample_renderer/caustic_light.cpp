#include "sample_renderer/caustic_light.h"

#include "scene/bsdf.h"

#include <algorithm>

namespace chiaro {
namespace {

// What reflects or transmits less makes no light that stands out.
constexpr float kLeastFocus = 0.15f;

constexpr std::uint32_t kAimedSalt = 0xa13ed;

// What a material focuses, by one of its places.
float focusing_part(const Scene& scene, const SurfacePoint& place) {
    const Bsdf b = bsdf_at(scene, place, true);
    if (b.alpha > kRoughestFocus * kRoughestFocus) return 0;
    const float reflected = has_facets(b) ? (1 - b.glass) * max_component(b.f0) : 0.0f;
    const float part = std::max(reflected, b.thin ? 0.0f : b.glass);
    return part < kLeastFocus ? 0.0f : part;
}

// Aims a ray at the surfaces; false if none may be seen from here.
bool aim(const SampledSurfaces& focusing, const Receiver& receiver, const Sequence& sequence,
         std::uint32_t sample, PathWave& wave, std::vector<SurfacePoint>& aims) {
    const std::uint32_t replicate = sample % kReplicates, index = sample / kReplicates;
    const auto found =
        focusing.sample(lit_place(receiver), sequence.number(sample, kFirstLightChoice),
                        sequence.sparse_pair(replicate, index, kFirstLightPlace));
    if (!found) return false;
    const Vec3 between = found->position - receiver.origin;
    const float squared = glm::dot(between, between);
    if (!(squared > 0)) return false;
    const Vec3 direction = between / std::sqrt(squared);
    if (!(receiving_cosine(receiver, direction) > 0)) return false;
    Path path = make_path(sequence, sample, replicate);
    path.key = hash32(path.key, kAimedSalt);
    wave.add({receiver.origin, direction}, path);
    aims.push_back(found->point);
    return true;
}

// Density over solid angle with which aimed rays meet the hit.
float pdf_aimed(const SampledSurfaces& focusing, const LitPlace& place, Vec3 direction,
                const Hit& hit) {
    const float cosine = std::abs(glm::dot(hit.normal, direction));
    if (!(cosine > 0)) return 0;
    return focusing.pdf(place, hit.point.object, hit.point.primitive) * hit.t * hit.t / cosine;
}

// Leaves out the aimed rays, those from `cosine_rays` on, that something else stopped, and weights
// all the rest: the throughput of either kind is the cosine / pi over the sum of the densities.
void weigh(const SampledSurfaces& focusing, const Receiver& receiver, std::size_t cosine_rays,
           std::span<const SurfacePoint> aims, PathWave& wave) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < wave.paths.size(); ++i) {
        const Hit& hit = wave.hits[i];
        if (!hit) continue;
        if (i >= cosine_rays) {
            const SurfacePoint& aim = aims[i - cosine_rays];
            if (hit.point.object != aim.object || hit.point.primitive != aim.primitive) continue;
        }
        const Vec3 direction = wave.rays[i].direction;
        const float by_cosine = pdf_receiving_cosine(receiver, direction);
        const float aimed = pdf_aimed(focusing, lit_place(receiver), direction, hit);
        const float weight = by_cosine / (by_cosine + aimed);
        wave.paths[i].throughput = Rgb(weight);
        if (i >= cosine_rays) wave.paths[i].roulette_scale = 1 / weight;
        wave.paths[left] = wave.paths[i];
        wave.rays[left] = wave.rays[i];
        wave.hits[left++] = hit;
    }
    wave.paths.resize(left);
    wave.rays.resize(left);
    wave.hits.resize(left);
}

}  // namespace

SampledSurfaces focusing_surfaces(const Scene& scene) {
    std::vector<SurfaceWeight> weights(scene.materials.size());
    std::vector<char> known(scene.materials.size(), 0);
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        if (scene.objects[o].mesh == MeshId::none) continue;
        const std::vector<Primitive>& primitives = scene.mesh_of(scene.objects[o]).primitives;
        for (std::uint32_t p = 0; p < primitives.size(); ++p) {
            const std::size_t material = index_of(primitives[p].material);
            if (known[material]) continue;
            known[material] = 1;
            weights[material].weight =
                focusing_part(scene, {static_cast<ObjectId>(o), p, 0.25f, 0.25f});
        }
    }
    return SampledSurfaces(scene, weights);
}

RayCount add_caustic_samples(const LitScene& lit, const SampledSurfaces& focusing,
                             const OpenSides* open_sides, const Receiver& receiver,
                             std::uint32_t seed, std::uint32_t first, std::uint32_t count,
                             PathWave& scratch, std::span<Rgb, kReplicates> sums) {
    thread_local std::vector<SurfacePoint> aims;
    aims.clear();
    start_paths(receiver, seed, first, count, scratch);
    const Sequence sequence(seed);
    if (!focusing.empty())
        for (std::uint32_t i = first; i < first + count; ++i)
            aim(focusing, receiver, sequence, i, scratch, aims);

    scratch.hits.resize(scratch.rays.size());
    lit.caster.intersect(scratch.rays, scratch.hits);
    const RayCount rays = count_inside(open_sides, std::span(scratch.hits).first(count));
    weigh(focusing, receiver, count, aims, scratch);
    std::array<Rgb, kReplicates> radiance = {};
    follow(lit, scratch, FirstEmission::skipped, radiance);
    for (std::uint32_t r = 0; r < kReplicates; ++r) sums[r] += kPi * radiance[r];
    return rays;
}

}  // namespace chiaro
