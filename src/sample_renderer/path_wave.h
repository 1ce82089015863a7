// Paths that advance together, bounce by bounce: every ray of a bounce goes to the caster in one
// call, in packets of 16, and paths that ended make room (Laine et al. 2013's wavefront, on a CPU).
#pragma once

#include "sample_renderer/next_event.h"
#include "sample_renderer/sequence.h"

#include <functional>

namespace chiaro {

/// One path under way; its ray and hit stand at the same place in the wave's arrays.
struct Path {
    static constexpr std::uint32_t kAimedFirst = 2;

    Rgb throughput = Rgb(1);
    float pdf = 0;          // of the ray's direction over solid angle, for the weight of emission;
                            // 0: no light sample finds what it meets
    Vec3 normal = Vec3(0);  // LitPlace's, where the ray started; after the first hit
    std::uint32_t first = 1;   // it is still on its first ray, though that may have passed panes;
                               // kAimedFirst: which was aimed
    std::uint32_t slot = 0;    // which sum it adds to
    std::uint32_t key = 0;     // names its random numbers after the first hit's
    Vec2 light_place = {};     // at the first hit: where on a light,
    float light_choice = 0;    // which of each kind of light,
    Vec2 sky_place = {};       // and where in the environment;
    float roulette_scale = 1;  // of the throughput, for survival: what is small because radiance in
                               // glass is dense, or because of a weight, is worth following
    std::optional<Vec2> direction = std::nullopt;  // where it surely goes on, if that is chosen yet
};

/// The path of `sample` of the sequence before its first ray.
inline Path make_path(const Sequence& sequence, std::uint32_t sample, std::uint32_t slot) {
    return {.slot = slot,
            .key = sequence.key(sample),
            .light_place = sequence.pair(sample, kFirstLightPlace),
            .light_choice = sequence.number(sample, kFirstLightChoice),
            .sky_place = sequence.rotated_pair(sample, kFirstLightPlace, kFirstSkyRotation)};
}

/// Shadow rays on the way, and what each brings to which sum through what is in its way.
struct ShadowBatch {
    std::vector<Ray> rays;
    std::vector<Rgb> values;
    std::vector<std::uint32_t> slots;
    std::vector<Ray> second_rays;          // of those that a mirror bends,
    std::vector<std::uint32_t> second_of;  // and which they belong to
    std::vector<Rgb> through;

    void clear();
    void add(const LightConnection& connection, Rgb value, std::uint32_t slot);
    /// Of the lanes that were found; rays start at `origin`.
    void add(const LightConnections8& connections, const Vec3x8& origin, const Vec3x8& value,
             std::span<const std::uint32_t, kLanes> lane_slots);
    /// Casts all rays, adds what arrives to sums[slot], and clears.
    void settle(const RayCaster& caster, std::span<Rgb> sums);
};

/// A wave and its scratch memory; reuse it, so that nothing is allocated in the inner loop. Paths
/// are independent of each other, but a hit's last bits may depend on who shares a packet: what
/// must be reproducible by itself needs a wave of its own.
struct PathWave {
    std::vector<Ray> rays;  // directions of unit length
    std::vector<Hit> hits;  // as many as rays, once cast; before that anything
    std::vector<Path> paths;
    ShadowBatch shadows;

    void clear();
    void add(const Ray& ray, const Path& path);
};

/// What a path takes of the light that the first surface it meets emits, or of the environment
/// where it meets none.
enum class FirstEmission { skipped, counted };

/// Up to eight paths that met surfaces with diffuse light, in lanes.
struct Meetings {
    std::span<const Path> paths;
    std::span<const Hit> hits;  // at distance Hit::t
    const Receiver8& met;
    const Vec3x8& reflected;  // throughput after a diffuse reflection here; divided by pi, radiance
                              // over irradiance
    std::uint32_t bounce;
    std::uint32_t lanes;  // a bit for each that asks; others hold anything
};

/// Asked before paths are lit where they are: those of the lanes that it returns end for diffuse
/// light, whoever is asked having added what it knows.
using EndsAt = std::function<std::uint32_t(const Meetings& meetings)>;

/// Follows all paths of the wave to their ends and adds the radiance that each finds along its
/// first ray, times its throughput, to sums[slot]. The first hits must be in place: the caller
/// casts the first rays, as they are of many kinds. Each point asks one light of each kind; next
/// event estimation and emission met by chance are weighted by the balance heuristic (Veach and
/// Guibas 1995); Russian roulette with survival up to 0.98, no other bound on the number of
/// bounces. Smooth panes let rays on that light samples pass too: such a ray remains one ray.
void follow(const LitScene& lit, PathWave& wave, FirstEmission first, std::span<Rgb> sums,
            const EndsAt* ends_at = nullptr);

}  // namespace chiaro
