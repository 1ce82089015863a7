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
    Vec2 place = Vec2(0);  // in the tangent plane, in cells
    float squared_distance = kInfinity;
    std::uint32_t vertex = 0;
    float weight = 0;
};

// Value at the origin of the linear function that fits values at `near` best, with weights that
// decrease with the distance: the weights of those values in it. Their sum is 1.
void fit_linear(std::span<Neighbor> near) {
    float total = 0;
    Vec2 mean(0);
    for (Neighbor& n : near) {
        n.weight = 1 / (n.squared_distance + 0.01f);
        total += n.weight;
        mean += n.weight * n.place;
    }
    mean /= total;
    float xx = 0, xy = 0, yy = 0;
    for (const Neighbor& n : near) {
        const Vec2 d = n.place - mean;
        xx += n.weight * d.x * d.x;
        xy += n.weight * d.x * d.y;
        yy += n.weight * d.y * d.y;
    }
    // Where all lie on a line, nothing is known of slopes across it: zero.
    const float ridge = 1e-4f * (xx + yy) + 1e-12f;
    xx += ridge;
    yy += ridge;
    const Vec2 slope =
        Vec2(yy * mean.x - xy * mean.y, xx * mean.y - xy * mean.x) / (xx * yy - xy * xy);
    for (Neighbor& n : near) n.weight *= 1 / total - glm::dot(n.place - mean, slope);
}

// To multiples of 1 / kFullWeight, the largest remainders rounded up.
ParentSet quantized(std::span<const Neighbor> near) {
    ParentSet result;
    std::array<float, 4> missing = {};
    int left = MeshGraph::kFullWeight;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const float exact = MeshGraph::kFullWeight * std::clamp(near[i].weight, 0.0f, 1.0f);
        const int whole = std::min(static_cast<int>(exact), left);
        result.vertices[i] = near[i].vertex;
        result.weights[i] = static_cast<std::uint8_t>(whole);
        missing[i] = exact - static_cast<float>(whole);
        left -= whole;
    }
    for (; left > 0; --left) {
        const auto most = std::max_element(missing.begin(), missing.begin() + near.size());
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

ParentSet choose_parents(const LevelVertex& vertex, std::span<const LevelVertex> candidates,
                         float cell) {
    // Vertices of regular meshes lie along the frame's axes: quadrants are turned from these.
    constexpr float kTurnCosine = 0.9211f, kTurnSine = 0.3894f;
    const Frame frame(vertex.normal);
    std::array<Neighbor, 4> nearest;
    for (const LevelVertex& candidate : candidates) {
        if (!continues(vertex, candidate, cell)) continue;
        const Vec3 d = (candidate.position - vertex.position) / cell;
        const Vec2 place(glm::dot(frame.s, d), glm::dot(frame.t, d));
        const int right = kTurnCosine * place.x + kTurnSine * place.y > 0;
        const int above = kTurnCosine * place.y - kTurnSine * place.x > 0;
        Neighbor& n = nearest[2 * above + right];
        const float squared = glm::dot(d, d);
        if (squared < n.squared_distance) n = {place, squared, candidate.vertex};
    }
    auto end = std::remove_if(nearest.begin(), nearest.end(),
                              [](const Neighbor& n) { return n.squared_distance == kInfinity; });

    // Those on the far side of others would weigh less than nothing: done without, one by one.
    while (end - nearest.begin() > 1) {
        fit_linear({nearest.begin(), end});
        const auto least = std::min_element(
            nearest.begin(), end,
            [](const Neighbor& a, const Neighbor& b) { return a.weight < b.weight; });
        if (least->weight >= 0) break;
        end = std::move(least + 1, end, least);
    }
    if (end == nearest.begin()) return {};
    if (end == nearest.begin() + 1) nearest[0].weight = 1;
    return quantized({nearest.begin(), end});
}

}  // namespace chiaro
