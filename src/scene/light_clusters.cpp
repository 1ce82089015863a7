// How the tree of clusters is walked.

#include "scene/light_clusters.h"

#include "base/error.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>

namespace chiaro {

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
    __m256 at_light = _mm256_blendv_ps(leaning, distance, straight);
    if (node.spots) {
        // Nothing beyond the whole angle: where the sine of it less the place's is below 0, with
        // room for the box and for rounding.
        const __m256 cosine = load(node.cos_reach);
        const __m256 room = absolute(cosine) * radius + _mm256_set1_ps(4e-4f) * distance;
        const __m256 most = load(node.sin_reach) * (facing + depth) + room;
        at_light = _mm256_and_ps(at_light, _mm256_cmp_ps(most, cosine * aside, _CMP_GE_OQ));
    }

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
