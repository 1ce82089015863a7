// Ear clipping (Meisters, "Polygons Have Ears", 1975) with the state of each ear kept up to date,
// so that a polygon of n corners takes O(n^2) steps at most.

#include "import/ear_clip.h"

#include "import/directions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace chiaro {
namespace {

using Point = glm::dvec2;

constexpr std::uint32_t kNone = Primitive::kNoCorner;

// Twice the signed area of a triangle: positive if counter-clockwise.
double cross_area(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The polygon seen against `normal`, so that it runs counter-clockwise: along the axis that it
// faces most.
std::vector<Point> project(std::span<const Vec3> corners, glm::dvec3 normal) {
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const double sign = normal[axis] < 0 ? -1 : 1;
    std::vector<Point> points;
    points.reserve(corners.size());
    for (const Vec3 c : corners) points.emplace_back(sign * c[(axis + 1) % 3], c[(axis + 2) % 3]);
    return points;
}

// Convex: every corner turns left, and the outline goes right and back left only once.
bool is_convex(const std::vector<Point>& points) {
    const std::size_t count = points.size();
    int reversals = 0;
    double last_step = 0;
    for (std::size_t i = 0; i <= count; ++i) {
        const Point a = points[i % count], b = points[(i + 1) % count], c = points[(i + 2) % count];
        if (cross_area(a, b, c) < 0) return false;
        const double step = b.x - a.x;
        if (step == 0) continue;
        if (step * last_step < 0) ++reversals;
        last_step = step;
    }
    return reversals <= 2;
}

// Whether the triangles of Embree's map, (0, 1, 3) and (2, 3, 1), lie side by side and bend little.
bool is_fair_quad(std::span<const Vec3> p) {
    constexpr double kLeastCosine = 0.94;  // 20 degrees
    const auto normal = [&](int a, int b, int c) {
        return glm::cross(glm::dvec3(p[b]) - glm::dvec3(p[a]), glm::dvec3(p[c]) - glm::dvec3(p[a]));
    };
    const auto alike = [&](glm::dvec3 a, glm::dvec3 b) {
        const double lengths = glm::length(a) * glm::length(b);
        return lengths > 0 && glm::dot(a, b) >= kLeastCosine * lengths;
    };
    return alike(normal(0, 1, 3), normal(2, 3, 1));
}

// A corner of what is left of the polygon, in a ring.
struct RingCorner {
    std::uint32_t previous, next;
    bool reflex;  // turns right, or not at all
    bool ear;     // the triangle with its neighbours holds no other corner and can be cut off
};

class EarClipper {
public:
    explicit EarClipper(const std::vector<Point>& points) : points_(points), ring_(points.size()) {
        const auto count = static_cast<std::uint32_t>(points.size());
        for (std::uint32_t i = 0; i < count; ++i)
            ring_[i] = {(i + count - 1) % count, (i + 1) % count, false, false};
        for (std::uint32_t i = 0; i < count; ++i) update_reflex(i);
        reflex_.resize(count);
        std::iota(reflex_.begin(), reflex_.end(), 0u);
        std::erase_if(reflex_, [&](std::uint32_t i) { return !ring_[i].reflex; });
        for (std::uint32_t i = 0; i < count; ++i) update_ear(i);
    }

    void clip_all(std::vector<PolygonPiece>& pieces) {
        std::uint32_t at = 0;
        std::size_t left = ring_.size(), misses = 0;
        while (left > 3) {
            // A ring without an ear crosses itself or has no area: any corner must do.
            if (!ring_[at].ear && misses < left) {
                at = ring_[at].next;
                ++misses;
                continue;
            }
            const auto [previous, next, reflex, ear] = ring_[at];
            pieces.push_back({previous, at, next, kNone});
            remove(at);
            at = next;
            --left;
            misses = 0;
        }
        pieces.push_back({ring_[at].previous, at, ring_[at].next, kNone});
    }

private:
    Point point(std::uint32_t i) const { return points_[i]; }

    void update_reflex(std::uint32_t i) {
        ring_[i].reflex = cross_area(point(ring_[i].previous), point(i), point(ring_[i].next)) <= 0;
    }

    void update_ear(std::uint32_t i) { ring_[i].ear = !ring_[i].reflex && holds_no_corner(i); }

    // Only a reflex corner can lie in an ear. A corner on the ear's rim blocks it, unless it stands
    // on one of the ear's own corners, as the ends of a bridge to a hole do.
    bool holds_no_corner(std::uint32_t i) const {
        const Point a = point(ring_[i].previous), b = point(i), c = point(ring_[i].next);
        return std::ranges::none_of(reflex_, [&](std::uint32_t other) {
            const Point p = point(other);
            return ring_[other].reflex && p != a && p != b && p != c && cross_area(a, b, p) >= 0 &&
                   cross_area(b, c, p) >= 0 && cross_area(c, a, p) >= 0;
        });
    }

    void remove(std::uint32_t i) {
        const auto [previous, next, reflex, ear] = ring_[i];
        ring_[previous].next = next;
        ring_[next].previous = previous;
        ring_[i].reflex = false;
        update_reflex(previous);
        update_reflex(next);
        update_ear(previous);
        update_ear(next);
    }

    const std::vector<Point>& points_;
    std::vector<RingCorner> ring_;
    std::vector<std::uint32_t> reflex_;  // those that were reflex at first: none becomes so later
};

// Length of the shortest loop that `corners` runs round a whole number of times (by the failure
// function of Knuth, Morris and Pratt).
std::size_t loop_length(std::span<const Vec3> corners) {
    std::vector<std::size_t> border(corners.size(), 0);
    for (std::size_t i = 1, length = 0; i < corners.size(); ++i) {
        while (length > 0 && corners[i] != corners[length]) length = border[length - 1];
        if (corners[i] == corners[length]) ++length;
        border[i] = length;
    }
    const std::size_t period = corners.size() - border.back();
    return corners.size() % period == 0 && period >= 3 ? period : corners.size();
}

// A fan of quads round corner 0, with a triangle at its end if the corners are odd in number.
void fan_out(std::span<const Vec3> corners, std::vector<PolygonPiece>& pieces) {
    const auto count = static_cast<std::uint32_t>(corners.size());
    for (std::uint32_t i = 1; i + 1 < count; i += 2) {
        const bool quad = i + 2 < count && is_fair_quad(std::array{corners[0], corners[i],
                                                                   corners[i + 1], corners[i + 2]});
        pieces.push_back({0, i, i + 1, quad ? i + 2 : kNone});
        if (!quad && i + 2 < count) pieces.push_back({0, i + 1, i + 2, kNone});
    }
}

}  // namespace

bool split_polygon(std::span<const Vec3> corners, std::vector<PolygonPiece>& pieces) {
    corners = corners.first(loop_length(corners));
    if (corners.size() == 3) {
        pieces.push_back({0, 1, 2, kNone});
        return true;
    }
    const std::vector<Point> points = project(corners, vector_area(corners));
    const bool convex = is_convex(points);
    if (corners.size() == 4 && convex && is_fair_quad(corners)) {
        pieces.push_back({0, 1, 2, 3});
        return true;
    }
    if (corners.size() > 4 && convex) {
        fan_out(corners, pieces);
        return true;
    }
    if (corners.size() > kMaxConcaveCorners) return false;
    EarClipper(points).clip_all(pieces);
    return true;
}

}  // namespace chiaro
