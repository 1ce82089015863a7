#include "scene/curved_shapes.h"

#include "base/error.h"
#include "scene/bicubic_mesh.h"

#include <cmath>

namespace chiaro {
namespace {

// A conic's three control points, homogeneous, as a cubic's four.
CubicCurve elevated(Vec4 a, Vec4 b, Vec4 c) {
    return {a, (a + 2.0f * b) / 3.0f, (2.0f * b + c) / 3.0f, c};
}

Vec4 with_weight(Vec2 p, float w) {
    return {w * p.x, w * p.y, 0, w};
}

Vec2 on_circle(float degrees) {
    // Quarter turns to the last bit, so that ends meet.
    const float quarters = degrees / 90;
    if (quarters == std::round(quarters)) {
        constexpr Vec2 kQuarters[] = {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)};
        return kQuarters[static_cast<int>(quarters) & 3];
    }
    const float angle = glm::radians(degrees);
    return {std::cos(angle), std::sin(angle)};
}

// Turns a profile's point along a circle's, both homogeneous.
Vec4 turned_by(Vec4 profile, Vec4 circle) {
    return {profile.x * circle.x, profile.y * circle.w, profile.x * circle.y, profile.w * circle.w};
}

// Unit tangent of the curve through a run of points without edges, at one of them.
Vec2 tangent_at(std::span<const Vec2> run, std::size_t i) {
    const std::size_t last = run.size() - 1;
    const bool ends = i == 0 || i == last;
    if (!ends) return glm::normalize(run[i + 1] - run[i - 1]);
    const Vec2 chord = i == 0 ? run[1] - run[0] : run[last] - run[last - 1];
    if (last == 1) return glm::normalize(chord);
    if (run[i].x == 0) return {i == 0 ? 1 : -1, 0};
    // As on a circle, the tangents at both ends of a chord stand in one angle to it.
    const Vec2 along = glm::normalize(chord);
    const Vec2 other = tangent_at(run, i == 0 ? 1 : last - 1);
    return 2 * glm::dot(along, other) * along - other;
}

}  // namespace

CubicCurve line_curve(Vec2 from, Vec2 to) {
    return bezier_curve(from, glm::mix(from, to, 1 / 3.0f), glm::mix(from, to, 2 / 3.0f), to);
}

CubicCurve bezier_curve(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    return {with_weight(a, 1), with_weight(b, 1), with_weight(c, 1), with_weight(d, 1)};
}

CubicCurve arc_curve(Vec2 centre, float radius, float from, float to) {
    check(std::abs(to - from) <= 90, "arc_curve: at most a quarter of a circle");
    const Vec2 a = on_circle(from), c = on_circle(to);
    // The tangents at the ends meet there (The NURBS Book, 7.3).
    const float w = std::cos(0.5f * glm::radians(std::abs(to - from)));
    const Vec2 b = (a + c) / (1 + glm::dot(a, c));
    return elevated(with_weight(centre + radius * a, 1), with_weight(centre + radius * b, w),
                    with_weight(centre + radius * c, 1));
}

std::vector<CubicCurve> smooth_profile(std::span<const Vec2> points) {
    std::vector<CubicCurve> curves;
    std::size_t start = 0;
    for (std::size_t end = 1; end <= points.size(); ++end) {
        if (end < points.size() && points[end] != points[end - 1]) continue;
        const std::span<const Vec2> run = points.subspan(start, end - start);
        for (std::size_t i = 0; i + 1 < run.size(); ++i) {
            const float reach = glm::distance(run[i], run[i + 1]) / 3;
            curves.push_back(bezier_curve(run[i], run[i] + reach * tangent_at(run, i),
                                          run[i + 1] - reach * tangent_at(run, i + 1), run[i + 1]));
        }
        start = end;
    }
    return curves;
}

Mesh revolve(std::span<const CubicCurve> profile) {
    Mesh mesh;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const auto turn = static_cast<float>(quarter);
        const CubicCurve circle = arc_curve(Vec2(0), 1, -90 * turn, -90 * (turn + 1));
        for (std::size_t k = 0; k < profile.size(); ++k) {
            BicubicPatch patch;
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) patch.at(i, j) = turned_by(profile[k][j], circle[i]);
            const auto along = static_cast<float>(k);
            const Vec2 low(turn / 4, along), high((turn + 1) / 4, along + 1);
            add_bicubic(mesh, patch, MaterialId{0}, {low, {high.x, low.y}, high, {low.x, high.y}});
        }
    }
    order_primitives(mesh);
    return mesh;
}

Mesh curved_sphere(float radius) {
    const CubicCurve halves[] = {arc_curve(Vec2(0), radius, -90, 0),
                                 arc_curve(Vec2(0), radius, 0, 90)};
    return revolve(halves);
}

}  // namespace chiaro
