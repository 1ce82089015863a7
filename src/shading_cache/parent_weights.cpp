#include "shading_cache/parent_weights.h"

#include "shading_cache/mesh_graph.h"

#include <algorithm>
#include <cmath>

namespace chiaro {
namespace {

constexpr float kFarthest = 2;          // cells
constexpr float kLeastCosine = 0.7f;    // 45 degrees
constexpr float kMostStep = 0.06f;      // from sheet to sheet, in cells
constexpr float kMostSteepness = 0.1f;  // the same, of the distance

// How far the two planes may be from the circle that would touch both, as a part of how far they
// are turned from each other: curvature is not the same everywhere.
constexpr float kMostUnevenness = 0.5f;

// A parent as seen from the vertex.
struct Neighbor {
    glm::dvec2 place = glm::dvec2(0);  // in the tangent plane, in cells
    double squared_distance = kInfinity;
    double weight = 0;
    std::uint32_t vertex = 0;
};

using Neighbors = std::array<Neighbor, 4>;

// Weights of values at those of `near` whose bit is set in `subset`, others 0, in the value at the
// origin of the linear function that fits these values best, the nearer the better. Their sum is 1.
void fit_linear(Neighbors& near, unsigned subset) {
    double total = 0;
    glm::dvec2 mean(0);
    for (unsigned i = 0; i < near.size(); ++i) {
        near[i].weight = subset >> i & 1 ? 1 / (near[i].squared_distance + 0.01) : 0;
        total += near[i].weight;
        mean += near[i].weight * near[i].place;
    }
    mean /= total;
    double xx = 0, xy = 0, yy = 0;
    for (const Neighbor& n : near) {
        const glm::dvec2 d = n.place - mean;
        xx += n.weight * d.x * d.x;
        xy += n.weight * d.x * d.y;
        yy += n.weight * d.y * d.y;
    }
    // Where all lie on a line, nothing is known of slopes across it: zero.
    const double ridge = 1e-4 * (xx + yy) + 1e-9 * total;
    xx += ridge;
    yy += ridge;
    const glm::dvec2 slope =
        glm::dvec2(yy * mean.x - xy * mean.y, xx * mean.y - xy * mean.x) / (xx * yy - xy * xy);
    for (Neighbor& n : near) n.weight *= 1 / total - glm::dot(n.place - mean, slope);
}

bool no_weight_is_negative(const Neighbors& near) {
    return std::ranges::all_of(near, [](const Neighbor& n) { return n.weight >= 0; });
}

// How far weights are from speaking of the origin, before all, and how far away those are on which
// they lie.
double defect(const Neighbors& near) {
    glm::dvec2 place(0);
    double spread = 0;
    for (const Neighbor& n : near) {
        place += n.weight * n.place;
        if (n.weight > 0) spread += n.weight * n.squared_distance;
    }
    return 100 * glm::dot(place, place) + spread;
}

// Weights >= 0: of all that are there or, where some would weigh less than nothing, of those that
// do best without the others.
void weigh(Neighbors& near) {
    unsigned all = 0;
    for (unsigned i = 0; i < near.size(); ++i)
        if (near[i].squared_distance < kInfinity) all |= 1U << i;
    fit_linear(near, all);
    if (no_weight_is_negative(near)) return;
    unsigned best = 0;
    double least = kInfinity;
    for (unsigned subset = 1; subset < all; ++subset) {
        if ((subset & all) != subset) continue;
        fit_linear(near, subset);
        if (!no_weight_is_negative(near) || defect(near) >= least) continue;
        least = defect(near);
        best = subset;
    }
    fit_linear(near, best);
}

// To multiples of 1 / kFullWeight, the largest remainders rounded up.
ChosenParents quantized(const Neighbors& near) {
    ChosenParents result;
    std::array<double, 4> missing;
    int left = MeshGraph::kFullWeight;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const double exact = MeshGraph::kFullWeight * near[i].weight;
        const int whole = std::min(static_cast<int>(exact), left);
        result.vertices[i] = near[i].vertex;
        result.weights[i] = static_cast<std::uint8_t>(whole);
        missing[i] = exact - whole;
        left -= whole;
    }
    for (; left > 0; --left) {
        const auto most = std::ranges::max_element(missing);
        ++result.weights[most - missing.begin()];
        *most -= 1;
    }
    return result;
}

}  // namespace

bool continues(const LevelVertex& a, const LevelVertex& b, float cell) {
    const Vec3 d = b.position - a.position;
    const float squared = glm::dot(d, d);
    if (squared > kFarthest * kFarthest * cell * cell || a.material != b.material) return false;
    if (glm::dot(a.normal, b.normal) < kLeastCosine) return false;

    // A circle through both at right angles to both normals rises over one tangent plane as it
    // falls below the other; sheets one before the other do not.
    const float rise = glm::dot(a.normal, d), fall = glm::dot(b.normal, d);
    const float step = 0.5f * std::abs(rise + fall);
    const float turn = 0.5f * std::abs(rise - fall);
    const float flat = std::min(kMostSteepness * std::sqrt(squared), kMostStep * cell);
    return step <= flat + kMostUnevenness * turn;
}

ChosenParents choose_parents(const LevelVertex& vertex, std::span<const LevelVertex> candidates,
                             float cell) {
    // Vertices of regular meshes lie along the frame's axes: quadrants are turned from these.
    constexpr float kTurnCosine = 0.9211f, kTurnSine = 0.3894f;
    const Frame frame(vertex.normal);
    Neighbors nearest;
    bool any = false;
    for (const LevelVertex& candidate : candidates) {
        const Vec3 d = (candidate.position - vertex.position) * (1 / cell);
        const Vec2 place(glm::dot(frame.s, d), glm::dot(frame.t, d));
        const int right = kTurnCosine * place.x + kTurnSine * place.y > 0;
        const int above = kTurnCosine * place.y - kTurnSine * place.x > 0;
        Neighbor& n = nearest[2 * above + right];
        const float squared = glm::dot(d, d);
        if (squared >= n.squared_distance || !continues(vertex, candidate, cell)) continue;
        n = {place, squared, 0, candidate.vertex};
        any = true;
    }
    if (!any) return {};
    weigh(nearest);
    return quantized(nearest);
}

}  // namespace chiaro
