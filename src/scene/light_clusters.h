// Which of many lights to ask at a place: a tree of clusters of lights, walked at random from the
// root to one light, so that near ones that face the place are chosen often and the others seldom.
// Source: Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting", PACMCGIT 1(2), 2018 (their adaptive splitting is left out). We
// chose nodes of eight children, whose importances are computed at once.
#pragma once

#include "base/color.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace chiaro {

/// Where light is wanted: only what lies on the side of `normal` counts.
struct LitPlace {
    Vec3 position;
    Vec3 normal;  // unit
};

/// What a light, or a cluster of lights, may be and do. It emits as Lambert's law says about
/// normals within a cone, up to an angle from them.
struct LightBounds {
    Box box;
    Vec3 axis = Vec3(0, 0, 1);  // of the cone of normals; unit
    float cone = 0;             // its half angle [radians], up to pi; pi: a point shines anywhere
    float reach = kPi / 2;   // the angle, up to pi / 2; a spot has a cone of normals and no reach
    bool two_sided = false;  // something in it emits backward too
    float intensity = 0;     // along the normal: luminance x area [cd, in metres]; > 0
};

/// What a light of that colour counts for in a choice. Luminance alone would leave out a blue so
/// deep that Y rounds to nothing.
inline float choice_weight(Rgb color) {
    return luminance(color) + 1e-6f * max_component(color);
}

/// The bounds of both together. A light of no intensity adds nothing.
LightBounds merge(const LightBounds& a, const LightBounds& b);

/// Chooses one light of many by what each may bring to a place: intensity x bounds of both cosines
/// / squared distance, never occlusion. What lies behind the place's horizon or faces away is never
/// chosen. One light is always chosen, at no cost.
///
/// Thread: const calls from any number of threads. The same lights give the same tree.
class LightClusters {
public:
    LightClusters() = default;
    explicit LightClusters(std::span<const LightBounds> lights);

    struct Choice {
        std::uint32_t light;  // in the order given
        float probability;    // > 0
    };

    /// `u` in [0, 1); nothing if no light can shine on the place, or the walk ends in a cluster
    /// that seemed to have one that can: that sample is worth nothing, and the probabilities of all
    /// lights sum to less than 1 by as much. Neighbours have neighbouring `u`. Checks: there is a
    /// light.
    std::optional<Choice> sample(const LitPlace& place, float u) const;

    /// Probability with which sample() gives this light at this place, to rounding.
    float pdf(const LitPlace& place, std::uint32_t light) const;

private:
    static constexpr std::uint32_t kWidth = 8;
    static constexpr std::uint32_t kIsLight = 0x8000'0000;
    using Lanes = std::array<float, kWidth>;

    // Eight clusters side by side. Unused ones have no intensity.
    struct alignas(32) Node {
        Lanes centre[3] = {}, extent[3] = {};  // extent: half the box
        Lanes radius = {};                     // of the sphere about the box; > 0
        Lanes axis[3] = {};
        Lanes cos_cone = {}, sin_cone = {};
        Lanes cos_reach = {}, sin_reach = {};  // of the largest angle from the axis that is lit
        Lanes intensity = {};
        std::array<std::uint32_t, kWidth> sign_bits =
            {};                                        // of the cosine at the light: kept or not
        std::array<std::uint32_t, kWidth> child = {};  // a node, or kIsLight and a light
        std::uint32_t parent = 0;                      // of the root: itself
        std::uint32_t slot = 0;                        // in the parent
        bool spots = false;  // something here has less than Lambert's reach
    };
    struct Leaf {
        std::uint32_t node;
        std::uint32_t slot;
    };
    struct Importances;
    class Builder;

    static Importances importances(const Node& node, const LitPlace& place);

    std::vector<Node> nodes_;   // the root first; none where one light needs no choice
    std::vector<Leaf> leaves_;  // by light
};

}  // namespace chiaro
