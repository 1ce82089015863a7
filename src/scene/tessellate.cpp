#include "scene/tessellate.h"

#include "base/error.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace chiaro {
namespace {

constexpr int kMostSegments = 256;

// Second derivatives are looked at in so many places across, and trusted up to this factor.
constexpr int kLooks = 8;
constexpr float kSafety = 1.2f;

// The error of so many chords of a curve whose second derivative is at most `second`.
float chord_error(float second, int segments) {
    const auto n = static_cast<float>(segments);
    return kSafety * second / (8 * n * n);
}

// Segments, a power of two, that keep the error within `tolerance`.
int segments_for(float second, float tolerance) {
    int segments = 1;
    while (segments < kMostSegments && chord_error(second, segments) > tolerance) segments *= 2;
    return segments;
}

// The same seen from `origin`: far away, rounding would pass for curvature.
Vec4 seen_from(Vec3 origin, const Vec4& p) {
    return {Vec3(p) - p.w * origin, p.w};
}
CubicCurve seen_from(Vec3 origin, CubicCurve curve) {
    for (Vec4& p : curve) p = seen_from(origin, p);
    return curve;
}
BicubicPatch seen_from(Vec3 origin, BicubicPatch patch) {
    for (Vec4& p : patch.points) p = seen_from(origin, p);
    return patch;
}

Vec3 second_difference(Vec3 before, Vec3 here, Vec3 after, float step) {
    return (before - 2.0f * here + after) / (step * step);
}

// Both patches beside an edge see it from the same end, and so to the same bits.
CubicCurve from_lower_end(const CubicCurve& curve) {
    const auto key = [](const Vec4& p) { return std::make_tuple(p.x, p.y, p.z, p.w); };
    const auto here = std::make_tuple(key(curve[0]), key(curve[1]));
    const auto there = std::make_tuple(key(curve[3]), key(curve[2]));
    return there < here ? reversed(curve) : curve;
}

// Of one edge: its segments, and their error.
struct Chords {
    int segments = 1;
    float error = 0;
};

Chords chords_of(const CubicCurve& edge, const ToleranceIn& tolerance) {
    const Box box = hull(edge);
    if (!(box.diagonal() > 0)) return {};
    const CubicCurve curve = seen_from(Vec3(edge[0]) / edge[0].w, edge);
    constexpr float kStep = 1.0f / kLooks;
    float second = 0;
    for (int k = 0; k < kLooks; ++k) {
        const float t = kStep * static_cast<float>(k);
        second =
            std::max(second, glm::length(second_difference(
                                 curve_position(curve, t), curve_position(curve, t + kStep / 2),
                                 curve_position(curve, t + kStep), kStep / 2)));
    }
    const int segments = segments_for(second, tolerance(box));
    return {segments, chord_error(second, segments)};
}

// The largest second derivatives of a patch.
struct Bends {
    float uu = 0, uv = 0, vv = 0;

    // Of a grid: Filip, Magedson and Markot, "Surface algorithms using bounds on derivatives",
    // 1986.
    float error(int columns, int rows) const {
        const auto n = static_cast<float>(columns), m = static_cast<float>(rows);
        return kSafety / 8 * (uu / (n * n) + 2 * uv / (n * m) + vv / (m * m));
    }
};

Bends bends_of(const BicubicPatch& whole) {
    const BicubicPatch patch = seen_from(whole.place(0, 0), whole);
    constexpr float kStep = 1.0f / kLooks, kHalf = kStep / 2;
    Bends bends;
    auto& [uu, uv, vv] = bends;
    for (int j = 0; j < kLooks; ++j)
        for (int i = 0; i < kLooks; ++i) {
            const Vec2 at = kStep * (Vec2(i, j) + 0.5f);
            const auto place = [&](float u, float v) {
                return patch_position(patch, at + kHalf * Vec2(u, v));
            };
            const Vec3 here = place(0, 0);
            uu = std::max(uu,
                          glm::length(second_difference(place(-1, 0), here, place(1, 0), kHalf)));
            vv = std::max(vv,
                          glm::length(second_difference(place(0, -1), here, place(0, 1), kHalf)));
            const Vec3 twist = place(1, 1) - place(-1, 1) - place(1, -1) + place(-1, -1);
            uv = std::max(uv, glm::length(twist) / (4 * kHalf * kHalf));
        }
    return bends;
}

// Points of a grid's side, of `count` segments, on the polyline of an edge.
std::vector<Vec3> points_on_edge(const CubicCurve& edge, int segments, int count) {
    const CubicCurve curve = from_lower_end(edge);
    const bool backward = curve != edge;
    std::vector<Vec3> corners;
    for (int k = 0; k <= segments; ++k)
        corners.push_back(
            curve_position(curve, static_cast<float>(k) / static_cast<float>(segments)));
    if (backward) std::reverse(corners.begin(), corners.end());

    std::vector<Vec3> points;
    const int each = count / segments;
    for (int k = 0; k <= count; ++k) {
        const int corner = k / each;
        const float part = static_cast<float>(k % each) / static_cast<float>(each);
        points.push_back(part == 0 ? corners[corner]
                                   : glm::mix(corners[corner], corners[corner + 1], part));
    }
    return points;
}

// How a patch is divided: its edges, and the grid that meets all of them.
struct Plan {
    std::array<int, 4> of_edge;  // segments
    PatchGrid grid;
    float error = 0;
};

Plan plan_grid(const BicubicPatch& patch, const ToleranceIn& tolerance) {
    Plan plan;
    for (int side = 0; side < 4; ++side) {
        const Chords chords = chords_of(from_lower_end(patch_edge(patch, side)), tolerance);
        plan.of_edge[side] = chords.segments;
        plan.error = std::max(plan.error, chords.error);
    }
    // Half of the error for each direction.
    const Bends bends = bends_of(patch);
    const float half = 0.5f * tolerance(hull(patch));
    const int inside_u = segments_for(bends.uu + bends.uv, half);
    const int inside_v = segments_for(bends.vv + bends.uv, half);
    plan.grid.columns =
        static_cast<std::uint16_t>(std::max({inside_u, plan.of_edge[0], plan.of_edge[2]}));
    plan.grid.rows =
        static_cast<std::uint16_t>(std::max({inside_v, plan.of_edge[1], plan.of_edge[3]}));
    plan.error = std::max(plan.error, bends.error(plan.grid.columns, plan.grid.rows));
    return plan;
}

void fill_grid(const BicubicPatch& patch, const Plan& plan, std::span<Vec3> points) {
    const int columns = plan.grid.columns, rows = plan.grid.rows;
    const auto at = [&](int i, int j) -> Vec3& { return points[j * (columns + 1) + i]; };
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            at(i, j) =
                patch_position(patch, Vec2(static_cast<float>(i) / static_cast<float>(columns),
                                           static_cast<float>(j) / static_cast<float>(rows)));

    // Sides 2 and 3 run against u and v.
    for (int side = 0; side < 4; ++side) {
        const int count = side % 2 == 0 ? columns : rows;
        const auto edge = points_on_edge(patch_edge(patch, side), plan.of_edge[side], count);
        for (int k = 0; k <= count; ++k) {
            if (side == 0) at(k, 0) = edge[k];
            if (side == 1) at(columns, k) = edge[k];
            if (side == 2) at(columns - k, rows) = edge[k];
            if (side == 3) at(0, rows - k) = edge[k];
        }
    }
}

std::vector<Plan> make_plans(std::span<const BicubicPatch> patches, const ToleranceIn& tolerance,
                             int threads) {
    std::vector<Plan> plans(patches.size());
    parallel_for(threads, patches.size(),
                 [&](std::size_t i) { plans[i] = plan_grid(patches[i], tolerance); });
    return plans;
}

std::size_t points_of(std::span<const Plan> plans) {
    std::size_t sum = 0;
    for (const Plan& plan : plans) sum += plan.grid.points();
    return sum;
}

}  // namespace

std::size_t grid_points(std::span<const BicubicPatch> patches, const ToleranceIn& tolerance,
                        int threads) {
    return points_of(make_plans(patches, tolerance, threads));
}

std::size_t PatchGrids::triangles() const {
    std::size_t count = 0;
    for (const PatchGrid& grid : grids) count += std::size_t{2} * grid.columns * grid.rows;
    return count;
}

PatchGrids tessellate(std::span<const BicubicPatch> patches, const ToleranceIn& tolerance,
                      int threads) {
    std::vector<Plan> plans = make_plans(patches, tolerance, threads);
    if (points_of(plans) > kMostGridPoints)
        throw Error("curved surfaces",
                    "one object takes more than " + std::to_string(kMostGridPoints) + " points",
                    "allow a larger --curve-error");
    PatchGrids result;
    std::size_t points = 0;
    for (Plan& plan : plans) {
        plan.grid.first = static_cast<std::uint32_t>(points);
        points += plan.grid.points();
        result.grids.push_back(plan.grid);
        result.error = std::max(result.error, plan.error);
    }
    result.points.resize(points);
    parallel_for(threads, patches.size(), [&](std::size_t i) {
        const PatchGrid& grid = plans[i].grid;
        fill_grid(patches[i], plans[i],
                  std::span(result.points).subspan(grid.first, grid.points()));
    });
    return result;
}

}  // namespace chiaro
