// The points that a cycle wants shaded, from selection to what is stored.
#pragma once

#include "sample_renderer/sample_renderer.h"
#include "shading_cache/shading_cache.h"

#include <span>
#include <unordered_set>
#include <vector>

namespace chiaro {

/// What each channel of a cache holds, and with how many samples a vertex is first evaluated.
struct ChannelPlan {
    Light light = Light::direct;
    std::uint32_t first_samples = 32;
    std::uint32_t indirect_samples = 0;  // of Light::total
    bool finds_buried = false;  // vertices that its results show to be in a solid are marked so
    // So are those at which it has found no light by kEnoughToBeDark samples, nor any other channel
    // has; until it finds some after all.
    bool zero_is_buried = false;

    bool operator==(const ChannelPlan&) const = default;
};

/// Requests of one cycle. Each (vertex, channel) is asked for at most once a cycle.
class ShadeWork {
public:
    /// `seed` is the session's; a vertex's own follows from it, its place and its channel. `eye` is
    /// where glossy light is seen from. From `enough_to_be_dark` samples without any light on one
    /// is dark.
    ShadeWork(std::vector<ChannelPlan> plans, std::uint64_t seed, Vec3 eye = Vec3(0),
              std::uint32_t enough_to_be_dark = kEnoughToBeDark);

    /// Asks for `samples` first samples of a vertex (0: as the plan says), unless it is evaluated
    /// or asked for. Returns whether it was added.
    bool evaluate(const ShadingCache& cache, VertexId vertex, int channel,
                  std::uint32_t samples = 0);
    /// Asks for as many samples again as an evaluated vertex has, at most kMostAtOnce, unless it
    /// has all that are counted; of a stale one for `of_stale` that take the place of what it has.
    bool resample(const ShadingCache& cache, VertexId vertex, int channel, std::uint32_t of_stale);

    std::size_t points() const;
    /// The vertices asked for in a channel.
    std::span<const VertexId> vertices(int channel) const { return channels_[channel].vertices; }
    /// Samples asked for of a channel.
    std::size_t samples(int channel) const { return channels_[channel].samples; }

    /// Shades a channel's requests and stores what comes back. Returns the seconds that it took.
    double shade(ShadingCache& cache, SampleRenderer& renderer, int channel, Cycle now);

    /// What it takes to know whether those vertices of this work that have found no light are dark:
    /// the other channels of irradiance, where they are not known or stale, and more samples.
    ShadeWork doubts(const ShadingCache& cache) const;

    static constexpr std::uint32_t kMostAtOnce = 8192;
    static constexpr std::uint32_t kEnoughToBeDark = 256;
    /// In haste, to be judged again.
    static constexpr std::uint32_t kFewToBeDark = 64;

private:
    bool add(const ShadingCache& cache, VertexId vertex, int channel, std::uint32_t first,
             std::uint32_t samples);
    bool surely_dark(const ShadingCache& cache, VertexId vertex) const;
    void judge_buried(ShadingCache& cache, VertexId vertex, int channel, bool found_buried) const;

    struct Channel {
        ChannelPlan plan;
        std::vector<VertexId> vertices;
        std::vector<ShadeRequest> requests;
        std::size_t samples = 0;
    };
    std::vector<Channel> channels_;
    std::unordered_set<std::uint64_t> asked_;
    std::uint64_t seed_;
    Vec3 eye_;
    std::uint32_t enough_to_be_dark_;
};

}  // namespace chiaro
