#include "update/shade_work.h"

#include "base/random.h"
#include "update/timings.h"

#include <algorithm>
#include <bit>
#include <chrono>

namespace chiaro {
namespace {

// A vertex is its place: made again there, it draws the same numbers. Those that share a place with
// what they speak for draw others.
std::uint32_t vertex_seed(const ShadingCache& cache, VertexId id, int channel,
                          std::uint64_t session_seed) {
    const CacheVertex& vertex = cache.vertex(id);
    std::uint32_t h = hash32(hash64(session_seed), vertex.surface_side);
    if (cache.relocated(id)) h = hash32(h, static_cast<std::uint32_t>(1 + cache.level(id)));
    h = hash32(h, std::bit_cast<std::uint32_t>(vertex.uv.x));
    h = hash32(h, std::bit_cast<std::uint32_t>(vertex.uv.y));
    return hash32(h, static_cast<std::uint32_t>(channel));
}

}  // namespace

ShadeWork::ShadeWork(std::vector<ChannelPlan> plans, std::uint64_t seed, Vec3 eye,
                     std::uint32_t enough_to_be_dark)
    : seed_(seed), eye_(eye), enough_to_be_dark_(enough_to_be_dark) {
    for (const ChannelPlan& plan : plans) channels_.push_back({plan, {}, {}, 0});
}

bool ShadeWork::evaluate(const ShadingCache& cache, VertexId vertex, int channel,
                         std::uint32_t samples) {
    if (cache.evaluated(vertex, channel)) return false;
    if (samples == 0) samples = channels_[channel].plan.first_samples;
    return add(cache, vertex, channel, 0, samples);
}

bool ShadeWork::resample(const ShadingCache& cache, VertexId vertex, int channel,
                         std::uint32_t of_stale) {
    const Estimate* e = cache.estimate(vertex, channel);
    if (!e) return evaluate(cache, vertex, channel);
    // From the first one on: none is mixed with those of the scene before.
    if (e->stale) return add(cache, vertex, channel, 0, of_stale);
    if (e->samples + kMostAtOnce > Estimate::kMostSamples) return false;
    return add(cache, vertex, channel, e->samples,
               std::min<std::uint32_t>(e->samples, kMostAtOnce));
}

bool ShadeWork::add(const ShadingCache& cache, VertexId vertex, int channel, std::uint32_t first,
                    std::uint32_t samples) {
    const std::uint64_t key = index_of(vertex) * 8 + static_cast<std::uint64_t>(channel);
    if (!asked_.insert(key).second) return false;
    Channel& c = channels_[channel];
    ShadeRequest request;
    request.where = cache.surface_point(vertex);
    request.front = cache.on_front(vertex);
    request.light = c.plan.light;
    request.eye = eye_;
    request.seed = vertex_seed(cache, vertex, channel, seed_);
    request.first_sample = first;
    request.samples = samples;
    request.indirect_samples = c.plan.indirect_samples;
    c.vertices.push_back(vertex);
    c.requests.push_back(request);
    c.samples += samples + c.plan.indirect_samples;
    return true;
}

std::size_t ShadeWork::points() const {
    std::size_t total = 0;
    for (const Channel& c : channels_) total += c.requests.size();
    return total;
}

double ShadeWork::shade(ShadingCache& cache, SampleRenderer& renderer, int channel, Cycle now) {
    Channel& c = channels_[channel];
    if (c.requests.empty()) return 0;
    const auto start = std::chrono::steady_clock::now();
    std::vector<ShadeResult> results(c.requests.size());
    renderer.shade(c.requests, results);
    const double seconds = seconds_since(start);

    // In the graph's order, so that a vertex finds its parents stored when it reckons its surplus.
    std::vector<std::size_t> order(results.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return c.vertices[a] < c.vertices[b]; });
    for (const std::size_t i : order) {
        const ShadeResult& r = results[i];
        cache.store(c.vertices[i], channel, r.mean, luminance_variance(r.variance),
                    c.requests[i].samples, now);
        judge_buried(cache, c.vertices[i], channel, r.buried);
    }
    return seconds;
}

// What was dark before an edit tells nothing of what is.
bool ShadeWork::surely_dark(const ShadingCache& cache, VertexId vertex) const {
    bool enough = false;
    for (std::size_t c = 0; c < channels_.size(); ++c) {
        const ChannelPlan& plan = channels_[c].plan;
        if (plan.light == Light::glossy) continue;
        const Estimate* e = cache.estimate(vertex, static_cast<int>(c));
        if (!e || e->stale || max_component(e->mean) > 0) return false;
        if (!plan.zero_is_buried) continue;
        if (e->samples < enough_to_be_dark_) return false;
        enough = true;
    }
    return enough;
}

void ShadeWork::judge_buried(ShadingCache& cache, VertexId vertex, int channel,
                             bool found_buried) const {
    const ChannelPlan& plan = channels_[channel].plan;
    if (!plan.finds_buried) return;
    if (found_buried || surely_dark(cache, vertex))
        cache.mark_buried(vertex);
    else if (plan.zero_is_buried && !cache.dark(vertex))
        cache.unmark_buried(vertex);
}

ShadeWork ShadeWork::doubts(const ShadingCache& cache) const {
    std::vector<ChannelPlan> plans;
    for (const Channel& c : channels_) plans.push_back(c.plan);
    ShadeWork more(plans, seed_, eye_, enough_to_be_dark_);
    const auto dark_so_far = [&](VertexId v, int channel) {
        const Estimate* e = cache.estimate(v, channel);
        return !e || e->stale || max_component(e->mean) == 0;
    };
    int count = static_cast<int>(channels_.size());
    while (count > 0 && channels_[count - 1].plan.light == Light::glossy) --count;
    for (int c = 0; c < count; ++c) {
        if (!channels_[c].plan.zero_is_buried) continue;
        for (const VertexId v : channels_[c].vertices) {
            if (cache.vertex(v).buried || cache.vertex(v).exposed) continue;
            bool dark = true;
            for (int other = 0; other < count; ++other) dark &= dark_so_far(v, other);
            if (!dark) continue;
            for (int other = 0; other < count; ++other) {
                const Estimate* e = cache.estimate(v, other);
                if (!e || e->stale) more.resample(cache, v, other, plans[other].first_samples);
            }
            if (cache.estimate(v, c)->samples < enough_to_be_dark_)
                more.resample(cache, v, c, enough_to_be_dark_);
        }
    }
    return more;
}

}  // namespace chiaro
