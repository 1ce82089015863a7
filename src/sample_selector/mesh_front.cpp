#include "sample_selector/mesh_front.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>

namespace chiaro {
namespace {

// Vertices whose gains one thread reckons at once.
constexpr std::size_t kAtOnce = 1024;

}  // namespace

void MeshFront::attach(const ShadingCache& cache) {
    vertices_.clear();
    levels_.clear();
    gains_.clear();
    places_.clear();
    const auto of_mesh = [](const CacheVertex& v) { return v.of_mesh != 0; };
    const auto count = std::ranges::count_if(cache.vertices(), of_mesh);
    vertices_.reserve(static_cast<std::size_t>(count));
    levels_.reserve(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < cache.vertices().size(); ++i) {
        if (!of_mesh(cache.vertices()[i])) continue;
        const auto id = static_cast<VertexId>(i);
        if (i >= places_.capacity()) places_.reserve(i + i / 16 + 64);
        places_.resize(i + 1, kNowhere);
        places_[i] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(id);
        levels_.push_back(static_cast<std::uint8_t>(std::min(cache.level(id), kLevels - 1)));
    }
    link(cache);
    weigh(cache);
}

// `for_each(add)` calls add(place, entry), in the same order whenever it is called.
template <typename T, typename ForEach>
MeshFront::Lists<T> MeshFront::make_lists(const ForEach& for_each) const {
    Lists<T> lists;
    lists.first.assign(vertices_.size() + 1, 0);
    for_each([&](std::size_t place, T) { ++lists.first[place + 1]; });
    for (std::size_t i = 0; i < vertices_.size(); ++i) lists.first[i + 1] += lists.first[i];
    lists.entries.resize(lists.first.back());
    std::vector<std::uint32_t> next(lists.first.begin(), lists.first.end() - 1);
    for_each([&](std::size_t place, T entry) { lists.entries[next[place]++] = entry; });
    return lists;
}

void MeshFront::link(const ShadingCache& cache) {
    children_ = make_lists<std::uint32_t>([&](const auto& add) {
        for (std::size_t place = 0; place < vertices_.size(); ++place)
            for (const VertexId parent : cache.parents(vertices_[place]))
                add(place_of(parent), static_cast<std::uint32_t>(place));
    });
    roots_ = make_lists<PatchId>([&](const auto& add) {
        for (std::size_t i = 0; i < cache.patches().size(); ++i) {
            const Patch& patch = cache.patches()[i];
            if (!patch.is_root() || patch.fragment_count == 0) continue;
            for (int c = 0; c < patch.corner_count(); ++c)
                add(place_of(patch.corners[c]), static_cast<PatchId>(i));
        }
    });
    marked_.assign((vertices_.size() + 63) / 64, 0);
}

void MeshFront::weigh(const ShadingCache& cache) {
    in_view_.assign(vertices_.size(), 0);
    for (auto& own : own_) own.assign(vertices_.size(), 0.0f);
    spoken_for_.assign(cache.channels(), std::vector<float>(vertices_.size(), 0.0f));

    // The pixels of roots fall on their corners in equal parts.
    for (const Patch& patch : cache.patches()) {
        if (!patch.is_root() || patch.fragment_count == 0) continue;
        const std::array<float, 2> pixels = {patch.pixels, patch.glossy_pixels};
        const auto part = 1 / static_cast<float>(patch.corner_count());
        for (int c = 0; c < patch.corner_count(); ++c) {
            const std::size_t place = place_of(patch.corners[c]);
            for (int kind = 0; kind < 2; ++kind) {
                own_[kind][place] += part * pixels[kind];
                if (pixels[kind] > 0) in_view_[place] |= static_cast<std::uint8_t>(1 << kind);
            }
            if (!told_by_levels(patch)) in_view_[place] |= kByLargePatch;
        }
    }

    // Then from fine to coarse: parents come before their children.
    for (std::size_t place = vertices_.size(); place-- > 0;) {
        const Parents parents = cache.parents(vertices_[place]);
        for (std::size_t i = 0; i < parents.size(); ++i) {
            const std::size_t parent = place_of(parents[i]);
            in_view_[parent] |= static_cast<std::uint8_t>(in_view_[place] & ~kByLargePatch);
            for (int c = 0; c < cache.channels(); ++c)
                if (!cache.evaluated(vertices_[place], c))
                    spoken_for_[c][parent] += parents.weight(i) * pixels(cache, place, c);
        }
    }
}

std::array<std::size_t, MeshFront::kLevels> MeshFront::count_by_level(Shading shading) const {
    std::array<std::size_t, kLevels> counts{};
    for (std::size_t place = 0; place < vertices_.size(); ++place)
        if (in_view(place, shading)) ++counts[levels_[place]];
    for (int l = kLevels - 1; l-- > 0;) counts[l] += counts[l + 1];
    return counts;
}

std::size_t MeshFront::place_of(VertexId vertex) const {
    return index_of(vertex) < places_.size() ? places_[index_of(vertex)] : kNowhere;
}

float MeshFront::pixels(const ShadingCache& cache, std::size_t place, int channel) const {
    const float spoken_for = std::max(0.0f, spoken_for_[channel][place]);
    if (cache.evaluated(vertices_[place], channel)) return spoken_for;
    return own_[static_cast<int>(cache.shading(channel))][place] + spoken_for;
}

// Takes pixels off all that spoke for a vertex.
void MeshFront::lift(const ShadingCache& cache, VertexId vertex, int channel, float pixels) {
    const Parents parents = cache.parents(vertex);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const float part = parents.weight(i) * pixels;
        spoken_for_[channel][place_of(parents[i])] -= part;
        if (!cache.evaluated(parents[i], channel)) lift(cache, parents[i], channel, part);
    }
}

std::vector<VertexId> MeshFront::settle(ShadingCache& cache, std::span<const VertexId> evaluated,
                                        int channel, const GainSettings& settings) {
    std::vector<VertexId> suspects;
    // Coarse ones first, so that each lifts all that weighed on it before.
    for (const VertexId id : evaluated) {
        const std::size_t place = place_of(id);
        if (place == kNowhere) continue;
        const Shading kind = cache.shading(channel);
        lift(cache, id, channel,
             own_[static_cast<int>(kind)][place] + std::max(0.0f, spoken_for_[channel][place]));
        blame(cache, id, channel, cache.surplus(id, channel), suspects);
        reckon(cache, id, channel, settings);
    }
    for (const VertexId id : suspects) reckon(cache, id, channel, settings);
    return suspects;
}

void MeshFront::unsettle(const ShadingCache& cache, VertexId forgotten, int channel,
                         const GainSettings& settings) {
    const std::size_t place = place_of(forgotten);
    if (place == kNowhere) return;
    lift(cache, forgotten, channel, -pixels(cache, place, channel));
    reckon(cache, forgotten, channel, settings);
}

// Lays a miss to those that spoke for a vertex, and to those farther above it by their part in
// that.
void MeshFront::blame(ShadingCache& cache, VertexId vertex, int channel, float surplus,
                      std::vector<VertexId>& suspects) const {
    const Parents parents = cache.parents(vertex);
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const VertexId parent = parents[i];
        if (!cache.evaluated(parent, channel))
            blame(cache, parent, channel, parents.weight(i) * surplus, suspects);
        else if (!cache.vertex(parent).buried && cache.suspect(parent, channel, surplus))
            suspects.push_back(parent);
    }
}

// Its part of the pixels of roots that gain nothing yet, as others of their corners are not
// evaluated.
float MeshFront::waiting(const ShadingCache& cache, std::size_t place, int channel) const {
    float sum = 0;
    for (const PatchId root : roots_.of(place)) {
        const Patch& patch = cache.patch(root);
        const auto corners = std::span(patch.corners).first(patch.corner_count());
        if (!std::ranges::all_of(corners, [&](VertexId v) { return cache.evaluated(v, channel); }))
            sum += cache.pixels(patch, channel) / static_cast<float>(corners.size());
    }
    return sum;
}

float MeshFront::gain_at(const ShadingCache& cache, std::size_t place, int channel,
                         const GainSettings& settings) const {
    const VertexId id = vertices_[place];
    const bool evaluated = cache.evaluated(id, channel);
    const float seen =
        pixels(cache, place, channel) + (evaluated ? waiting(cache, place, channel) : 0);
    if (!(seen > 0)) return 0;
    return evaluated ? gain_of_more(cache, id, channel, seen, settings)
                     : gain_of_first(cache, id, channel,
                                     {seen, (in_view_[place] & kByLargePatch) == 0}, settings);
}

void MeshFront::reckon(const ShadingCache& cache, const GainSettings& settings, int threads) {
    gains_.resize(cache.channels());
    std::vector<float> gains(vertices_.size());
    for (int c = 0; c < cache.channels(); ++c) {
        parallel_for_ranges(threads, gains.size(), kAtOnce, [&](IndexRange range) {
            for (std::size_t place = range.begin; place < range.end; ++place)
                gains[place] = gain_at(cache, place, c, settings);
        });
        gains_[c].assign(gains);
    }
}

void MeshFront::mark_children(const ShadingCache& cache, std::size_t place, int channel) {
    for (const std::uint32_t child : children_.of(place)) {
        const VertexId id = vertices_[child];
        if (cache.evaluated(id, channel) && !cache.vertex(id).buried) continue;
        marked_[child / 64] |= std::uint64_t{1} << (child % 64);
    }
}

std::size_t MeshFront::carry(ShadingCache& cache, std::span<const VertexId> news, int channel,
                             const GainSettings& settings, int threads) {
    std::size_t lowest = marked_.size();
    for (const VertexId id : news) {
        const std::size_t place = place_of(id);
        if (place == kNowhere) continue;
        mark_children(cache, place, channel);
        lowest = std::min(lowest, place / 64);
    }
    // Children come after their parents, so that one pass over the marks meets all.
    std::vector<std::uint32_t> carried;
    for (std::size_t word = lowest; word < marked_.size(); ++word)
        while (marked_[word] != 0) {
            const std::size_t place =
                64 * word + static_cast<std::size_t>(std::countr_zero(marked_[word]));
            marked_[word] &= marked_[word] - 1;
            if (cache.resolve(vertices_[place], channel)) mark_children(cache, place, channel);
            carried.push_back(static_cast<std::uint32_t>(place));
        }

    // What they gain depends on nothing but values.
    std::vector<float> gains(carried.size());
    parallel_for_ranges(threads, carried.size(), kAtOnce, [&](IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i)
            gains[i] = gain_at(cache, carried[i], channel, settings);
    });
    gains_[channel].set_many(carried, gains);
    return carried.size();
}

std::span<const PatchId> MeshFront::roots_round(VertexId vertex) const {
    const std::size_t place = place_of(vertex);
    if (place == kNowhere) return {};
    return roots_.of(place);
}

void MeshFront::reckon(const ShadingCache& cache, VertexId vertex, int channel,
                       const GainSettings& settings) {
    if (gains_.empty()) return;
    const std::size_t place = place_of(vertex);
    if (place != kNowhere) gains_[channel].set(place, gain_at(cache, place, channel, settings));
}

void MeshFront::rest(VertexId vertex, int channel) {
    if (gains_.empty()) return;
    const std::size_t place = place_of(vertex);
    if (place != kNowhere) gains_[channel].set(place, 0);
}

std::size_t MeshFront::bytes() const {
    std::size_t total = vertices_.capacity() * sizeof(VertexId) + levels_.capacity() +
                        in_view_.capacity() + places_.capacity() * sizeof(std::uint32_t) +
                        marked_.capacity() * sizeof(std::uint64_t);
    total += 4 * (children_.first.capacity() + children_.entries.capacity() +
                  roots_.first.capacity() + roots_.entries.capacity());
    for (const auto& own : own_) total += own.capacity() * sizeof(float);
    for (const auto& spoken_for : spoken_for_) total += spoken_for.capacity() * sizeof(float);
    for (const SumTree& gains : gains_) total += gains.bytes();
    return total;
}

}  // namespace chiaro
