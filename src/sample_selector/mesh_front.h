// Which vertices of dense meshes to evaluate next: the front of refinement above the patches.
#pragma once

#include "sample_selector/gain.h"
#include "sample_selector/sum_tree.h"

#include <array>
#include <span>
#include <vector>

namespace chiaro {

/// The vertices of meshes that the cache knows, with what each weighs in the view and would gain.
///
/// The pixels of a patch weigh on its corners. A vertex that is not evaluated hands what weighs on
/// it to its parents, which speak for it; an evaluated one keeps it. So what weighs on a vertex is
/// what changes with its value, and each channel has weights of its own.
///
/// Thread: one. Ids are the cache's and change when it packs: attach() again.
class MeshFront {
public:
    /// Takes up all vertices of meshes and weighs them in the view that is attached to the cache.
    /// None is drawn before reckon().
    void attach(const ShadingCache& cache);

    std::span<const VertexId> vertices() const { return vertices_; }  // in order
    /// Whether a vertex, by its place in vertices(), counts in that kind of shading in the view, as
    /// a corner in view or as one that predicts such a corner.
    bool in_view(std::size_t place, Shading shading) const {
        return in_view_[place] >> static_cast<int>(shading) & 1;
    }
    /// Whether it is a corner of a patch whose light shows in the view.
    bool shown(std::size_t place) const { return own_[0][place] > 0 || own_[1][place] > 0; }
    /// The coarsest level that it stands for.
    int level(std::size_t place) const { return levels_[place]; }
    static constexpr int kLevels = 16;
    /// Vertices in view that stand for level l or coarser ones, by l.
    std::array<std::size_t, kLevels> count_by_level(Shading shading) const;

    /// The weight of a vertex: if it is evaluated, that of vertices which it speaks for.
    float pixels(const ShadingCache& cache, std::size_t place, int channel) const;

    /// Vertices, in order, were evaluated in a channel for the first time: what they weigh is
    /// lifted off those that spoke for them, which are suspected where they spoke wrongly. Others
    /// than vertices of meshes are passed over. Returns the suspects: news for carry(), as all that
    /// they speak for gains by it.
    std::vector<VertexId> settle(ShadingCache& cache, std::span<const VertexId> evaluated,
                                 int channel, const GainSettings& settings);

    /// A vertex that was evaluated in a channel no longer is: what it weighs falls back on those
    /// that speak for it now.
    void unsettle(const ShadingCache& cache, VertexId forgotten, int channel,
                  const GainSettings& settings);

    /// Carries what is new at some vertices in a channel down to those that they speak for, and
    /// reckons their gains anew, on up to `threads` threads. Returns how many these were; touches
    /// no others.
    std::size_t carry(ShadingCache& cache, std::span<const VertexId> news, int channel,
                      const GainSettings& settings, int threads);
    /// The roots in view round a vertex.
    std::span<const PatchId> roots_round(VertexId vertex) const;

    /// Reckons gains anew, of all vertices (on up to `threads` threads) or of one.
    void reckon(const ShadingCache& cache, const GainSettings& settings, int threads);
    void reckon(const ShadingCache& cache, VertexId vertex, int channel,
                const GainSettings& settings);
    /// Takes a vertex out of the draw until its gain is reckoned again.
    void rest(VertexId vertex, int channel);

    double total(int channel) const { return gains_.empty() ? 0 : gains_[channel].total(); }
    VertexId draw(int channel, float u) const { return vertices_[gains_[channel].draw(u)]; }

    std::size_t bytes() const;

private:
    static constexpr std::uint32_t kNowhere = 0xffff'ffff;
    std::size_t place_of(VertexId vertex) const;
    void link(const ShadingCache& cache);
    void weigh(const ShadingCache& cache);
    void mark_children(const ShadingCache& cache, std::size_t place, int channel);
    void lift(const ShadingCache& cache, VertexId vertex, int channel, float pixels);
    float waiting(const ShadingCache& cache, std::size_t place, int channel) const;
    float gain_at(const ShadingCache& cache, std::size_t place, int channel,
                  const GainSettings& settings) const;

    /// What belongs to each vertex, by place: entries [first[place], first[place + 1]).
    template <typename T>
    struct Lists {
        std::vector<std::uint32_t> first;
        std::vector<T> entries;
        std::span<const T> of(std::size_t place) const {
            return std::span(entries).subspan(first[place], first[place + 1] - first[place]);
        }
    };
    template <typename T, typename ForEach>
    Lists<T> make_lists(const ForEach& for_each) const;

    void blame(ShadingCache& cache, VertexId vertex, int channel, float surplus,
               std::vector<VertexId>& suspects) const;

    std::vector<VertexId> vertices_;
    std::vector<std::uint32_t> places_;  // by VertexId up to the last: in vertices_, or kNowhere
    Lists<std::uint32_t> children_;      // places
    Lists<PatchId> roots_;
    std::vector<std::uint64_t> marked_;  // a bit a place, for carry()
    std::vector<std::uint8_t> levels_;
    static constexpr std::uint8_t kByLargePatch = 4;
    std::vector<std::uint8_t> in_view_;           // bit: Shading; kByLargePatch
    std::array<std::vector<float>, 2> own_;       // by Shading: pixels of the patches round it
    std::vector<std::vector<float>> spoken_for_;  // by channel: pixels of vertices it speaks for
    std::vector<SumTree> gains_;                  // by channel
};

}  // namespace chiaro
