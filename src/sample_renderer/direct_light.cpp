#include "sample_renderer/direct_light.h"

#include "sample_renderer/path_bounce.h"

namespace chiaro {
namespace {

constexpr std::uint32_t kLightSamplesPerRay = 8;

bool few(std::span<const std::uint32_t> lights) {
    return lights.size() <= kMostExactLights;
}

// A light sample that a ray may find too.
void add_light_sample(const std::optional<LightConnection>& connection, std::uint32_t slot,
                      ShadowBatch& shadows) {
    if (!connection) return;
    const float of_light = kLightSamplesPerRay * connection->pdf_solid_angle;
    const float weight = of_light / (of_light + connection->pdf_cosine());
    shadows.add(*connection, connection->irradiance * weight, slot);
}

void add_light_samples(const LitScene& lit, const Receiver& receiver, const Sequence& sequence,
                       std::uint32_t sample, std::uint32_t slot, ShadowBatch& shadows) {
    if (!lit.area_lights.empty())
        add_light_sample(connect_area_light(lit, receiver, sequence.number(sample, kLightChoice),
                                            sequence.pair(sample, kLightPlace)),
                         slot, shadows);
    if (!lit.environment.empty())
        add_light_sample(
            connect_environment(lit, receiver,
                                sequence.rotated_pair(sample, kLightPlace, kSkyRotation)),
            slot, shadows);
}

void add_ray(const Receiver& receiver, Vec2 u, std::uint32_t slot, PathWave& wave) {
    const Vec3 direction = sample_receiving_cosine(receiver, u);
    const float pdf = pdf_receiving_cosine(receiver, direction);
    if (pdf > 0)
        wave.add({receiver.origin, direction},
                 {.pdf = pdf, .normal = receiver.geometric_normal, .slot = slot});
}

// Light samples of all kinds of light that rays may find too, and those rays.
void start_samples(const LitScene& lit, std::span<const SampleRun> runs, PathWave& wave) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const auto& [receiver, seed, first, count] = runs[r];
        const Sequence sequence(seed);
        for (std::uint32_t i = first; i < first + count; ++i) {
            add_light_samples(lit, receiver, sequence, i, slot_of(r, i), wave.shadows);
            const std::uint32_t replicate = i % kReplicates, index = i / kReplicates;
            if (takes_turn(seed, replicate, index, kLightSamplesPerRay))
                add_ray(
                    receiver,
                    sequence.sparse_pair(replicate, index / kLightSamplesPerRay, kLightDirection),
                    slot_of(r, i), wave);
        }
    }
}

// What a cosine-distributed ray found that light samples find with that density. It stands for
// kLightSamplesPerRay of them.
Rgb met_light(const Path& path, Rgb radiance, float pdf_light) {
    const float of_light = kLightSamplesPerRay * pdf_light;
    return radiance * (kPi * kLightSamplesPerRay * path.pdf / (of_light + path.pdf));
}

// Emission that these rays meet, and behind panes; the environment where they meet nothing.
void settle_rays(const LitScene& lit, PathWave& wave, std::span<Rgb> sums) {
    const auto met = [&](const Path& path, const Ray& ray, const Hit& hit) {
        const Rgb radiance = path.throughput * emission(lit.scene, hit.point, hit.front);
        if (max_component(radiance) > 0)
            sums[path.slot] += met_light(
                path, radiance, pdf_area_light(lit, {ray.origin, path.normal}, ray.direction, hit));
    };
    const auto missed = [&](const Path& path, const Ray& ray) {
        if (!lit.environment.empty())
            sums[path.slot] +=
                met_light(path, path.throughput * lit.environment.radiance(ray.direction),
                          lit.environment.pdf({ray.origin, path.normal}, ray.direction));
    };
    cast_through_panes(lit, wave, met, missed);
}

// Lamps or suns, which no ray finds, chosen by `connect`.
template <typename Connect>
void add_chosen_lights(const LitScene& lit, std::span<const SampleRun> runs, ShadowBatch& shadows,
                       const Connect& connect) {
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const auto& [receiver, seed, first, count] = runs[r];
        const Sequence sequence(seed);
        for (std::uint32_t i = first; i < first + count; ++i)
            if (const auto connection = connect(lit, receiver, sequence.number(i, kLightChoice)))
                shadows.add(*connection, connection->irradiance, slot_of(r, i));
    }
}

}  // namespace

void add_exact_direct_light(const LitScene& lit, std::span<const SampleRun> runs, PathWave& scratch,
                            std::span<Rgb> sums) {
    scratch.shadows.clear();
    for (const auto& lights : {lit.punctual.lamps(), lit.punctual.suns()}) {
        if (!few(lights)) continue;
        for (std::uint32_t r = 0; r < runs.size(); ++r)
            for (const std::uint32_t light : lights)
                if (const auto connection = connect_punctual(lit, runs[r].receiver, light))
                    scratch.shadows.add(*connection, connection->irradiance, r);
    }
    scratch.shadows.settle(lit.caster, sums);
}

bool direct_light_is_exact(const LitScene& lit) {
    return lit.area_lights.empty() && lit.environment.empty() && few(lit.punctual.lamps()) &&
           few(lit.punctual.suns());
}

void add_direct_samples(const LitScene& lit, std::span<const SampleRun> runs, PathWave& scratch,
                        std::span<Rgb> sums) {
    scratch.clear();
    if (!lit.area_lights.empty() || !lit.environment.empty()) {
        start_samples(lit, runs, scratch);
        settle_rays(lit, scratch, sums);
    }
    if (!few(lit.punctual.lamps())) add_chosen_lights(lit, runs, scratch.shadows, connect_lamp);
    if (!few(lit.punctual.suns())) add_chosen_lights(lit, runs, scratch.shadows, connect_sun);
    scratch.shadows.settle(lit.caster, sums);
}

}  // namespace chiaro
