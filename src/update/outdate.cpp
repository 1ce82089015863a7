#include "update/outdate.h"

#include "base/parallel.h"
#include "sample_selector/gain.h"
#include "scene/perceived_gloss.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace chiaro {
namespace {

constexpr std::size_t kAtOnce = 4096;  // vertices that one thread judges

// Squared changes that an edit lets expect, over the light's square, until it is known better. A
// light that moves or is switched may change all; what moves in its way, a good part of direct
// light, and little of what comes from all sides.
constexpr float kByLights = 1;
constexpr float kInTheWay = 0.25f;
constexpr float kByOwnMaterial = 1;  // gloss
constexpr float kIndirectByLights = 0.25f;
constexpr float kIndirectByObjects = 0.02f;

float change_to_expect(Light light, const SceneChange& change) {
    const bool indirect = light == Light::indirect;
    if (change.lights) return indirect ? kIndirectByLights : kByLights;
    if (light == Light::direct) return change.geometry || change.passing ? kInTheWay : 0.0f;
    return change.any() ? kIndirectByObjects : 0.0f;
}

// What a surface shows of its surroundings is all its own material's, not theirs alone.
void expect_of_repainted(const ShadingCache& cache, const Scene& scene, const SceneChange& change,
                         ExpectedChange& expected) {
    if (change.repainted.empty() || !cache.has_glossy()) return;
    std::vector<char> repainted(scene.materials.size(), 0);
    for (const MaterialId material : change.repainted) repainted[index_of(material)] = 1;
    std::vector<char> meshes;
    for (const Mesh& mesh : scene.meshes)
        meshes.push_back(std::ranges::any_of(mesh.primitives, [&](const Primitive& primitive) {
            return repainted[index_of(primitive.material)] != 0;
        }));
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const Object& object = scene.objects[o];
        if (object.mesh == MeshId::none || !meshes[index_of(object.mesh)]) continue;
        for (int c = 0; c < cache.channels(); ++c)
            if (cache.shading(c) == Shading::glossy)
                expected.expect_of(static_cast<ObjectId>(o), c, kByOwnMaterial);
    }
}

// Mean squared change of gloss from which on it is seen anew, as if for the first time.
constexpr float kTellsNothing = 0.5f;

bool within(const Box& box, Vec3 p, float margin) {
    return glm::all(glm::greaterThanEqual(p, box.low - margin)) &&
           glm::all(glm::lessThanEqual(p, box.high + margin));
}

// Where a change may be felt.
struct Reach {
    const SceneChange& change;
    std::optional<LightReach> lights;  // where anything may be in their way
    bool any_direct;                   // direct light may have changed anywhere
    float margin = 0;

    Reach(const Scene& scene, const SceneChange& c) : change(c), any_direct(c.lights || c.passing) {
        if (c.boxes.empty()) return;
        lights.emplace(scene);
        margin = 1e-3f * bounds(scene).diagonal();
    }
    bool in_place_of_moved(Vec3 p) const {
        return std::ranges::any_of(change.boxes,
                                   [&](const Box& box) { return within(box, p, margin); });
    }
    bool in_the_way(const SurfacePoint& at, Vec3 p) const {
        return change.has_moved(at.object) ||
               std::ranges::any_of(change.boxes,
                                   [&](const Box& box) { return lights->may_cross(p, box); });
    }
};

struct Judgement {
    bool direct = false;  // its direct light may be another
    bool close = false;   // on what moved, or where that was or is now
    bool forget = false;  // it was buried, exposed or dark, and need not be any more
};

Judgement judge(const ShadingCache& cache, const Scene& scene, const Reach& reach, VertexId id) {
    const CacheVertex& vertex = cache.vertex(id);
    const SurfacePoint at = cache.surface_point(id);
    const Vec3 p = surface_position(scene, at);
    const bool blocked = (!reach.any_direct || vertex.buried) && reach.in_the_way(at, p);
    Judgement judged;
    judged.direct = reach.any_direct || blocked;
    judged.close =
        reach.change.geometry && (reach.change.has_moved(at.object) || reach.in_place_of_moved(p));
    judged.forget = (judged.close && (vertex.buried || vertex.exposed)) ||
                    (vertex.buried && (blocked || reach.change.passing || cache.dark(id)));
    return judged;
}

int first_glossy(const ShadingCache& cache) {
    int c = 0;
    while (cache.shading(c) != Shading::glossy) ++c;
    return c;
}

// Channels (bit c: channel c) that the picture shows of a vertex, as a corner of leaves or where
// such a corner is predicted from it.
std::vector<std::uint8_t> seen_in_view(const ShadingCache& cache) {
    std::vector<std::uint8_t> seen(cache.vertices().size(), 0);
    for (const Patch& patch : cache.patches()) {
        if (!patch.is_leaf() || patch.fragment_count == 0) continue;
        std::uint8_t lit = 0;
        for (int c = 0; c < cache.channels(); ++c)
            if (cache.pixels(patch, c) > 0) lit |= static_cast<std::uint8_t>(1u << c);
        for (int i = 0; i < patch.corner_count(); ++i) seen[index_of(patch.corners[i])] |= lit;
    }
    for (std::size_t i = seen.size(); i-- > 0;) {  // parents come before children
        const auto id = static_cast<VertexId>(i);
        std::uint8_t predicted = seen[i];
        for (int c = 0; c < cache.channels(); ++c)
            if (cache.evaluated(id, c)) predicted &= static_cast<std::uint8_t>(~(1u << c));
        if (predicted == 0) continue;
        for (const VertexId parent : cache.parents(id)) seen[index_of(parent)] |= predicted;
    }
    return seen;
}

// Channels in which somebody would sample a vertex again: it is of a mesh, or a corner of a patch
// in view that may be refined. Others were evaluated beside a channel that is refined farther.
std::vector<std::uint8_t> sampled_on(const ShadingCache& cache) {
    std::vector<std::uint8_t> sampled(cache.vertices().size(), 0);
    for (std::size_t i = 0; i < cache.patches().size(); ++i) {
        const auto id = static_cast<PatchId>(i);
        const Patch& patch = cache.patch(id);
        std::uint8_t front = 0;
        for (int c = 0; c < cache.channels(); ++c)
            if (cache.pixels(patch, c) > 0 && on_front(cache, id, c))
                front |= static_cast<std::uint8_t>(1u << c);
        for (int k = 0; k < patch.corner_count(); ++k) sampled[index_of(patch.corners[k])] |= front;
    }
    for (std::size_t i = 0; i < sampled.size(); ++i)
        if (cache.vertices()[i].of_mesh) sampled[i] = ShadingCache::kAllChannels;
    return sampled;
}

// How glossy it looks, at least 1.
float gloss_at(const ShadingCache& cache, const Scene& scene, VertexId id) {
    const Bsdf bsdf = bsdf_at(scene, cache.surface_point(id), cache.on_front(id));
    return std::max(1.0f, perceived_gloss(bsdf).strength());
}

// Squared change of what a surface of that gloss shows, over its square, as the eye moves.
float change_of_gloss(Vec3 place, float gloss, Vec3 eye_before, Vec3 eye) {
    // Of all the gloss there is, a sixth of a radian farther shows something else.
    constexpr float kSharpness = 3;
    const Vec3 before = safe_normalize(eye_before - place, Vec3(1, 0, 0));
    const float angle = glm::length(before - safe_normalize(eye - place, before));
    const float change = std::min(1.0f, kSharpness * gloss * angle);
    return change * change;
}

}  // namespace

LeastLight least_light(const PictureScale& scale) {
    constexpr float kTenthOfMiddle = 0.04f;  // comparison_exposure() takes the median to 0.4
    constexpr float kUsualAlbedo = 0.5f;
    const float radiance = kTenthOfMiddle / scale.exposure;
    return {scale.irradiance ? radiance : radiance * kPi / kUsualAlbedo, radiance};
}

float light2(const ShadingCache& cache, VertexId id, int channel, const LeastLight& least) {
    const Shading shading = cache.shading(channel);
    float light = luminance(cache.shown_total(id, shading).value);
    const Parents parents = cache.parents(id);
    float around = 0;
    for (std::size_t i = 0; i < parents.size(); ++i)
        around += parents.weight(i) * luminance(cache.shown_total(parents[i], shading).value);
    light = std::max(light, around);
    return light * light + least.of(shading) * least.of(shading);
}

void outdate(ShadingCache& cache, const Scene& scene, std::span<const ChannelPlan> plans,
             const SceneChange& change, const LeastLight& least, ExpectedChange& expected,
             int threads) {
    for (int c = 0; c < cache.channels(); ++c)
        expected.expect(scene.objects.size(), c, change_to_expect(plans[c].light, change));
    expect_of_repainted(cache, scene, change, expected);

    const Reach reach(scene, change);
    const auto channels = static_cast<std::size_t>(cache.channels());
    std::vector<char> forgotten(cache.vertices().size(), 0);
    std::vector<float> errors(channels * forgotten.size(), 0.0f);  // 0: as it was
    parallel_for_ranges(threads, forgotten.size(), kAtOnce, [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const auto id = static_cast<VertexId>(i);
            const CacheVertex& vertex = cache.vertex(id);
            if (!cache.evaluated(id) && !vertex.buried && !vertex.exposed) continue;
            const Judgement judged = judge(cache, scene, reach, id);
            forgotten[i] = judged.forget ? 1 : 0;
            if (judged.forget) continue;
            const ObjectId object = cache.surface_point(id).object;
            for (std::size_t c = 0; c < channels; ++c) {
                const auto channel = static_cast<int>(c);
                if (!cache.evaluated(id, channel)) continue;
                if (plans[c].light == Light::direct && !judged.direct) continue;
                const float part = judged.close ? kByLights : expected.relative2(object, channel);
                errors[channels * i + c] = part * light2(cache, id, channel, least);
            }
        }
    });

    for (std::size_t i = 0; i < forgotten.size(); ++i) {
        const auto id = static_cast<VertexId>(i);
        if (forgotten[i]) cache.forget(id);
        for (std::size_t c = 0; c < channels; ++c)
            if (const float error2 = errors[channels * i + c]; error2 > 0)
                cache.outdate(id, static_cast<int>(c), error2);
    }
}

std::vector<float> outdate_gloss(ShadingCache& cache, const Scene& scene, const EyeMove& move,
                                 const LeastLight& least, ExpectedChange& expected, int threads) {
    std::vector<float> rates(scene.objects.size(), 0.0f);
    if (!cache.has_glossy()) return rates;
    const int glossy = first_glossy(cache);
    std::vector<float> gloss(cache.vertices().size(), 0.0f), changes(gloss.size(), 0.0f);
    parallel_for_ranges(threads, changes.size(), kAtOnce, [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const auto id = static_cast<VertexId>(i);
            if (!cache.evaluated(id, glossy)) continue;
            gloss[i] = gloss_at(cache, scene, id);
            const Vec3 place = surface_position(scene, cache.surface_point(id));
            const Vec3 seen_from = move.track.at(*cache.estimate(id, glossy), move.now);
            changes[i] = change_of_gloss(place, gloss[i], seen_from, move.eye);
        }
    });

    double sum = 0, count = 0;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        if (gloss[i] == 0) continue;
        float& rate = rates[index_of(cache.surface_point(static_cast<VertexId>(i)).object)];
        rate = std::max(rate, gloss[i]);
        sum += changes[i];
        count += 1;
    }
    if (count == 0) return rates;
    const auto mean = static_cast<float>(sum / count);
    for (int c = glossy; c < cache.channels(); ++c) expected.expect(scene.objects.size(), c, mean);
    if (mean > kTellsNothing) {
        cache.forget_glossy();
        return rates;
    }
    for (std::size_t i = 0; i < changes.size(); ++i) {
        if (changes[i] == 0) continue;
        const auto id = static_cast<VertexId>(i);
        const float most = light2(cache, id, glossy, least);
        for (int c = glossy; c < cache.channels(); ++c) {
            const Estimate* e = cache.estimate(id, c);
            if (!e) continue;
            const float before = e->stale ? static_cast<float>(e->variance) : 0.0f;
            cache.outdate(id, c, std::max(before, changes[i] * most));
        }
    }
    return rates;
}

StaleCount reconsider_stale(ShadingCache& cache, const ExpectedChange& expected,
                            const LeastLight& least, const Waiting& waiting, int threads) {
    constexpr float kCyclesToDouble = 16;
    constexpr float kWorthChanging = 1.3f;
    const auto growth = [&](int channel) {
        const auto cycles = static_cast<float>(waiting.of(cache.shading(channel)));
        return std::exp2(std::min(cycles / kCyclesToDouble, 60.0f));
    };

    const auto channels = static_cast<std::size_t>(cache.channels());
    std::vector<float> errors(channels * cache.vertices().size(), 0.0f);
    parallel_for_ranges(threads, cache.vertices().size(), kAtOnce, [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const auto id = static_cast<VertexId>(i);
            if (!cache.evaluated(id)) continue;
            for (std::size_t c = 0; c < channels; ++c) {
                const auto channel = static_cast<int>(c);
                const Estimate* e = cache.estimate(id, channel);
                if (!e || !e->stale) continue;
                const ObjectId object = cache.surface_point(id).object;
                const float part =
                    std::min(1.0f, growth(channel) * expected.relative2(object, channel));
                errors[channels * i + c] = part * light2(cache, id, channel, least);
            }
        }
    });

    const std::vector<std::uint8_t> in_view = seen_in_view(cache);
    const std::vector<std::uint8_t> sampled = sampled_on(cache);
    StaleCount stale;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        if (errors[k] == 0) continue;
        const auto id = static_cast<VertexId>(k / channels);
        const auto channel = static_cast<int>(k % channels);
        const bool seen = in_view[k / channels] >> channel & 1 && !cache.vertex(id).buried;
        if (seen && !(sampled[k / channels] >> channel & 1)) {
            cache.forget(id, static_cast<std::uint8_t>(1u << channel));
            continue;
        }
        ++stale.all;
        if (seen) ++stale.in_view;
        const float before = cache.estimate(id, channel)->variance;
        const float factor = errors[k] / std::max(before, 1e-30f);
        if (factor > kWorthChanging || factor * kWorthChanging < 1)
            cache.outdate(id, channel, errors[k]);
    }
    return stale;
}

}  // namespace chiaro
