// How the tree of clusters is built.

#include "scene/light_clusters.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace chiaro {
namespace {

// From the axis to where nothing is lit.
float whole_angle(const LightBounds& b) {
    return std::min(b.cone + b.reach, kPi);
}

// What a cluster costs if it is reached: it brings error with its light, its size, and the
// directions that it may light (the paper's M_Omega).
float cost_of(const LightBounds& b) {
    const float cone = b.cone, whole = whole_angle(b);
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
    both.reach = std::max(a.reach, b.reach);
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
        node.cos_reach[slot] = std::cos(whole_angle(bounds));
        node.sin_reach[slot] = std::max(0.0f, std::sin(whole_angle(bounds)));
        node.spots |= bounds.reach < kPi / 2;
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

}  // namespace chiaro
