#include "scene/light_clusters.h"

#include "base/error.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace chiaro {
namespace {

// What a cluster costs if it is reached: it brings error with its light, its size, and the
// directions that it may face (the paper's M_Omega, for emission over a hemisphere).
float cost_of(const LightBounds& b) {
    const float cone = b.cone, whole = std::min(b.cone + kPi / 2, kPi);
    const float directions = 2 * kPi * (1 - std::cos(cone)) +
                             kPi / 2 *
                                 (2 * whole * std::sin(cone) - std::cos(cone - 2 * whole) -
                                  2 * cone * std::sin(cone) + std::cos(cone));
    const float diagonal = b.box.diagonal();
    return b.intensity * directions * diagonal * diagonal;
}

}  // namespace

// The cone is the narrowest about two cones, as in the paper. Where anything is two-sided
// an axis serves as well as its opposite.
LightBounds merge(const LightBounds& a, const LightBounds& b) {
    if (!(b.intensity > 0)) return a;
    if (!(a.intensity > 0)) return b;
    const LightBounds& wide = a.cone >= b.cone ? a : b;
    const LightBounds& narrow = a.cone >= b.cone ? b : a;
    LightBounds both = wide;
    both.box.add(narrow.box);
    both.two_sided = a.two_sided || b.two_sided;
    both.intensity = a.intensity + b.intensity;

    const bool turned = both.two_sided && glm::dot(wide.axis, narrow.axis) < 0;
    const Vec3 other = turned ? -narrow.axis : narrow.axis;
    if (other == wide.axis) return both;
    const float along = glm::dot(other, wide.axis);
    const Vec3 across = other - along * wide.axis;
    const float sine = glm::length(across);
    const float between = std::atan2(sine, along);
    if (between + narrow.cone <= wide.cone) return both;
    both.cone = sine > 0 ? std::min(0.5f * (wide.cone + between + narrow.cone), kPi) : kPi;
    const float turn = both.cone - wide.cone;
    if (both.cone < kPi)
        both.axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) / sine * across);
    return both;
}

// Splits groups of lights where the paper's surface area orientation heuristic is least, the
// costliest group first, until a node is full; then builds each group's own node.
class LightClusters::Builder {
public:
    Builder(std::span<const LightBounds> lights, LightClusters& tree)
        : lights_(lights), tree_(tree), order_(lights.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        tree_.leaves_.resize(lights.size());
        build(group(0, order_.size()), 0, 0);
    }

private:
    static constexpr int kBins = 12;

    struct Group {
        std::size_t first, last;  // in order_
        LightBounds bounds;
        float cost;
        std::size_t size() const { return last - first; }
    };
    struct Plane {
        int axis = -1, bin = 0;  // bin: the first on the far side
        float cost = kInfinity;
    };

    Group group(std::size_t first, std::size_t last) const {
        LightBounds bounds;
        for (std::size_t i = first; i < last; ++i) bounds = merge(bounds, lights_[order_[i]]);
        return {first, last, bounds, cost_of(bounds)};
    }

    int bin_of(std::uint32_t light, const Box& centres, int axis) const {
        const float place = (lights_[light].box.centre()[axis] - centres.low[axis]) /
                            (centres.high[axis] - centres.low[axis]);
        return std::clamp(static_cast<int>(place * kBins), 0, kBins - 1);
    }

    // The best plane across `axis` if it is better than `best`. Long clusters are cut across.
    void try_axis(const Group& g, const Box& centres, int axis, Plane& best) const {
        if (!(centres.high[axis] > centres.low[axis])) return;
        std::array<LightBounds, kBins> bins, from;
        for (std::size_t i = g.first; i < g.last; ++i) {
            LightBounds& bin = bins[bin_of(order_[i], centres, axis)];
            bin = merge(bin, lights_[order_[i]]);
        }
        from[kBins - 1] = bins[kBins - 1];
        for (int b = kBins - 2; b > 0; --b) from[b] = merge(bins[b], from[b + 1]);

        const Vec3 size = g.bounds.box.high - g.bounds.box.low;
        const float slenderness = std::max({size.x, size.y, size.z}) / size[axis];
        LightBounds before;
        for (int b = 1; b < kBins; ++b) {
            before = merge(before, bins[b - 1]);
            if (!(before.intensity > 0) || !(from[b].intensity > 0)) continue;
            const float found = slenderness * (cost_of(before) + cost_of(from[b]));
            if (found < best.cost) best = {axis, b, found};
        }
    }

    std::pair<Group, Group> split(const Group& g) {
        Box centres;
        for (std::size_t i = g.first; i < g.last; ++i) centres.add(lights_[order_[i]].box.centre());
        Plane best;
        for (int axis = 0; axis < 3; ++axis) try_axis(g, centres, axis, best);
        std::size_t middle = g.first + g.size() / 2;  // where all lie in one place
        if (best.axis >= 0) {
            const auto near = [&](std::uint32_t light) {
                return bin_of(light, centres, best.axis) < best.bin;
            };
            const auto all = order_.begin();
            middle = std::stable_partition(all + g.first, all + g.last, near) - all;
        }
        return {group(g.first, middle), group(middle, g.last)};
    }

    std::uint32_t build(const Group& whole, std::uint32_t parent, std::uint32_t slot) {
        std::vector<Group> groups = {whole};
        while (groups.size() < kWidth) {
            const auto lower = [](const Group& a, const Group& b) {
                return (a.size() > 1 ? a.cost : -1) < (b.size() > 1 ? b.cost : -1);
            };
            const auto costliest = std::max_element(groups.begin(), groups.end(), lower);
            if (costliest->size() == 1) break;
            const auto [near, far] = split(*costliest);
            *costliest = near;
            groups.insert(costliest + 1, far);
        }

        const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
        Node& node = tree_.nodes_.emplace_back();
        node.parent = parent;
        node.slot = slot;
        node.radius.fill(1);
        for (std::uint32_t i = 0; i < groups.size(); ++i) {
            put(tree_.nodes_[index], i, groups[i].bounds);
            const std::uint32_t light = order_[groups[i].first];
            const bool leaf = groups[i].size() == 1;
            if (leaf) tree_.leaves_[light] = {index, i};
            const auto child = leaf ? light | kIsLight : build(groups[i], index, i);
            tree_.nodes_[index].child[i] = child;  // only now: building moves the nodes
        }
        return index;
    }

    static void put(Node& node, std::uint32_t slot, const LightBounds& bounds) {
        const Vec3 centre = bounds.box.centre();
        const Vec3 extent = 0.5f * (bounds.box.high - bounds.box.low);
        for (int i = 0; i < 3; ++i) {
            node.centre[i][slot] = centre[i];
            node.extent[i][slot] = extent[i];
            node.axis[i][slot] = bounds.axis[i];
        }
        node.radius[slot] = std::max(glm::length(extent), 1e-15f);
        node.cos_cone[slot] = std::cos(bounds.cone);
        node.sin_cone[slot] = std::sin(bounds.cone);
        node.intensity[slot] = bounds.intensity;
        node.sign_bits[slot] = bounds.two_sided ? 0x7fff'ffff : 0xffff'ffff;
    }

    std::span<const LightBounds> lights_;
    LightClusters& tree_;
    std::vector<std::uint32_t> order_;
};

LightClusters::LightClusters(std::span<const LightBounds> lights) {
    if (lights.size() == 1) leaves_.resize(1);
    if (lights.size() > 1) Builder(lights, *this);
}

// Of a node's eight children, and their sums up to and with each.
struct LightClusters::Importances {
    alignas(32) Lanes each;
    alignas(32) Lanes up_to;
};

namespace {

template <typename T>
__m256 load(const std::array<T, 8>& lanes) {
    return _mm256_load_ps(reinterpret_cast<const float*>(lanes.data()));
}

__m256 absolute(__m256 x) {
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x);
}

// A bit for each lane of `x` that is greater than `limit`.
unsigned lanes_above(__m256 x, float limit) {
    return _mm256_movemask_ps(_mm256_cmp_ps(x, _mm256_set1_ps(limit), _CMP_GT_OQ));
}

// Running sums: within each half of four, then the low half's total onto the high half.
__m256 running_sums(__m256 x) {
    x = x + _mm256_castsi256_ps(_mm256_slli_si256(_mm256_castps_si256(x), 4));
    x = x + _mm256_castsi256_ps(_mm256_slli_si256(_mm256_castps_si256(x), 8));
    const __m256 low_total = _mm256_permute_ps(_mm256_permute2f128_ps(x, x, 0x08), 0xff);
    return x + low_total;
}

}  // namespace

// With d from the place to a box's centre, n.d + |n|.extent is the most that any of the box rises
// above the horizon, and likewise for the light's own plane: over the distance they bound the
// cosines, as nearly as importance needs, and are zero exactly where nothing can pass. Where a cone
// is wide, its normals lean toward the place by up to its half angle.
LightClusters::Importances LightClusters::importances(const Node& node, const LitPlace& place) {
    const __m256 zero = _mm256_setzero_ps();
    __m256 d2 = zero, above = zero, along = zero, depth = zero;  // depth: |axis|.extent
    for (int i = 0; i < 3; ++i) {
        const __m256 d = load(node.centre[i]) - _mm256_set1_ps(place.position[i]);
        const __m256 extent = load(node.extent[i]), axis = load(node.axis[i]);
        const __m256 normal = _mm256_set1_ps(place.normal[i]);
        d2 = d2 + d * d;
        above = above + normal * d + absolute(normal) * extent;
        along = along + axis * d;
        depth = depth + absolute(axis) * extent;
    }
    // No closer than the sphere about the box: inside it, all directions are possible.
    const __m256 radius = load(node.radius);
    const __m256 squared = _mm256_max_ps(d2, radius * radius);
    const __m256 distance = _mm256_sqrt_ps(squared);

    const __m256 facing = _mm256_and_ps(zero - along, load(node.sign_bits));
    const __m256 aside = _mm256_sqrt_ps(_mm256_max_ps(zero, d2 - along * along));
    const __m256 cos_cone = load(node.cos_cone), sin_cone = load(node.sin_cone);
    const __m256 leaning = cos_cone * (facing + depth) + sin_cone * (aside + radius);
    // A normal of the cone may point straight at the place; so it may anywhere, if the cone is half
    // of all directions.
    const __m256 straight = _mm256_or_ps(_mm256_cmp_ps(facing, cos_cone * distance, _CMP_GE_OQ),
                                         _mm256_cmp_ps(cos_cone, zero, _CMP_LE_OQ));
    const __m256 at_light = _mm256_blendv_ps(leaning, distance, straight);

    const __m256 inverse = _mm256_set1_ps(1) / squared;
    const auto up_to_distance = [&](__m256 x) {
        return _mm256_max_ps(zero, _mm256_min_ps(x, distance));
    };
    const __m256 each = load(node.intensity) * (up_to_distance(above) * inverse) *
                        (up_to_distance(at_light) * inverse);
    Importances found;
    _mm256_store_ps(found.each.data(), each);
    _mm256_store_ps(found.up_to.data(), running_sums(each));
    return found;
}

std::optional<LightClusters::Choice> LightClusters::sample(const LitPlace& place, float u) const {
    check(!leaves_.empty(), "LightClusters: nothing to choose");
    if (nodes_.empty()) return Choice{0, 1};
    Choice choice = {0, 1};
    for (std::uint32_t at = 0;;) {
        const Importances found = importances(nodes_[at], place);
        const float sum = found.up_to.back();
        const unsigned possible = lanes_above(load(found.each), 0);
        if (possible == 0) return std::nullopt;

        // The first child whose running sum exceeds u's, but none of no importance by rounding.
        const float target = u * sum;
        const unsigned beyond = possible & lanes_above(load(found.up_to), target);
        const unsigned slot =
            (beyond != 0 ? std::countr_zero(beyond) : std::bit_width(possible) - 1) % kWidth;

        const float importance = found.each[slot];
        const float before = slot == 0 ? 0.0f : found.up_to[slot - 1];
        choice.probability *= importance / sum;
        if (!(choice.probability > 0)) return std::nullopt;  // beyond what floats can tell from 0
        u = std::clamp((target - before) / importance, 0.0f, 0x1.fffffep-1f);
        at = nodes_[at].child[slot];
        if ((at & kIsLight) != 0) {
            choice.light = at & ~kIsLight;
            return choice;
        }
    }
}

float LightClusters::pdf(const LitPlace& place, std::uint32_t light) const {
    float probability = 1;
    if (nodes_.empty()) return probability;
    for (auto [at, slot] = leaves_[light];; slot = nodes_[at].slot, at = nodes_[at].parent) {
        const Importances found = importances(nodes_[at], place);
        if (!(found.each[slot] > 0)) return 0;
        probability *= found.each[slot] / found.up_to.back();
        if (at == 0) return probability;
    }
}

}  // namespace chiaro
