#include "scene/bicubic.h"

#include <optional>

namespace chiaro {
namespace {

// Bernstein polynomials of degree 3.
std::array<float, 4> bernstein(float t) {
    const float s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}
// Of degree 2, times 3: what differences of control points weigh in a derivative.
std::array<float, 3> slope_weights(float t) {
    const float s = 1 - t;
    return {3 * s * s, 6 * s * t, 3 * t * t};
}

Vec4 blend(const std::array<Vec4, 4>& points, const std::array<float, 4>& weights) {
    return weights[0] * points[0] + weights[1] * points[1] + weights[2] * points[2] +
           weights[3] * points[3];
}
Vec4 slope(const std::array<Vec4, 4>& points, const std::array<float, 3>& weights) {
    return weights[0] * (points[1] - points[0]) + weights[1] * (points[2] - points[1]) +
           weights[2] * (points[3] - points[2]);
}

// Row j of a patch, seen from `origin`, so that nothing cancels far from the origin.
CubicCurve row_from(const BicubicPatch& patch, int j, Vec3 origin) {
    CubicCurve row;
    for (int i = 0; i < 4; ++i) {
        const Vec4& p = patch.at(i, j);
        row[i] = {Vec3(p) - p.w * origin, p.w};
    }
    return row;
}

std::array<CubicCurve, 2> halves(const CubicCurve& c) {
    const Vec4 ab = 0.5f * (c[0] + c[1]), bc = 0.5f * (c[1] + c[2]), cd = 0.5f * (c[2] + c[3]);
    const Vec4 abc = 0.5f * (ab + bc), bcd = 0.5f * (bc + cd);
    const Vec4 middle = 0.5f * (abc + bcd);
    return {CubicCurve{c[0], ab, abc, middle}, CubicCurve{middle, bcd, cd, c[3]}};
}

}  // namespace

BicubicPatch make_bicubic(const std::array<Vec3, 16>& points) {
    BicubicPatch patch;
    for (int k = 0; k < 16; ++k) patch.points[k] = Vec4(points[k], 1);
    return patch;
}

PatchPoint patch_point(const BicubicPatch& patch, Vec2 uv) {
    const Vec3 origin = patch.place(0, 0);
    const auto u = bernstein(uv.x), v = bernstein(uv.y);
    const auto slope_u = slope_weights(uv.x), slope_v = slope_weights(uv.y);
    std::array<Vec4, 4> places, slopes;  // along u, by row
    for (int j = 0; j < 4; ++j) {
        const CubicCurve row = row_from(patch, j, origin);
        places[j] = blend(row, u);
        slopes[j] = slope(row, slope_u);
    }
    const Vec4 p = blend(places, v), du = blend(slopes, v), dv = slope(places, slope_v);
    const Vec3 place = Vec3(p) / p.w;
    return {origin + place, (Vec3(du) - du.w * place) / p.w, (Vec3(dv) - dv.w * place) / p.w};
}

Vec3 patch_position(const BicubicPatch& patch, Vec2 uv) {
    const auto u = bernstein(uv.x), v = bernstein(uv.y);
    std::array<Vec4, 4> places;
    for (int j = 0; j < 4; ++j)
        places[j] = blend({patch.at(0, j), patch.at(1, j), patch.at(2, j), patch.at(3, j)}, u);
    const Vec4 p = blend(places, v);
    return Vec3(p) / p.w;
}

namespace {

// The normal there, unless it is lost in rounding: at poles a tangent vanishes, at cusps both lie
// in one line.
std::optional<Vec3> normal_at(const BicubicPatch& patch, Vec2 uv, float smallest) {
    const PatchPoint p = patch_point(patch, uv);
    const float u = glm::length(p.du), v = glm::length(p.dv);
    if (!(u > smallest && v > smallest)) return std::nullopt;
    const Vec3 cross = glm::cross(p.du / u, p.dv / v);
    const float length = glm::length(cross);
    if (!(length > 1e-4f)) return std::nullopt;
    return cross / length;
}

}  // namespace

Vec3 patch_normal(const BicubicPatch& patch, Vec2 uv) {
    const float smallest = 1e-6f * hull(patch).diagonal();
    // Else a little farther inside, along both, or either.
    const Vec2 inside(uv.x < 0.5f ? 1 : -1, uv.y < 0.5f ? 1 : -1);
    if (const auto normal = normal_at(patch, uv, smallest)) return *normal;
    for (const float step : {1e-3f, 1e-2f, 0.1f, 0.3f})
        for (const Vec2 along : {Vec2(1, 1), Vec2(0, 1), Vec2(1, 0)})
            if (const auto normal = normal_at(patch, uv + step * inside * along, smallest))
                return *normal;
    return {0, 0, 1};
}

BicubicPatch transformed(const BicubicPatch& patch, const Mat4& affine) {
    BicubicPatch result;
    for (int k = 0; k < 16; ++k) result.points[k] = affine * patch.points[k];
    return result;
}

BicubicPatch flipped(const BicubicPatch& patch) {
    BicubicPatch result;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) result.at(j, i) = patch.at(i, j);
    return result;
}

std::array<BicubicPatch, 2> halves_in_u(const BicubicPatch& patch) {
    std::array<BicubicPatch, 2> parts;
    for (int j = 0; j < 4; ++j) {
        const auto rows = halves({patch.at(0, j), patch.at(1, j), patch.at(2, j), patch.at(3, j)});
        for (int half = 0; half < 2; ++half)
            for (int i = 0; i < 4; ++i) parts[half].at(i, j) = rows[half][i];
    }
    return parts;
}

std::array<BicubicPatch, 2> halves_in_v(const BicubicPatch& patch) {
    const auto parts = halves_in_u(flipped(patch));
    return {flipped(parts[0]), flipped(parts[1])};
}

CubicCurve patch_edge(const BicubicPatch& patch, int side) {
    CubicCurve curve;
    for (int k = 0; k < 4; ++k) {
        const int back = 3 - k;
        curve[k] = side == 0   ? patch.at(k, 0)
                   : side == 1 ? patch.at(3, k)
                   : side == 2 ? patch.at(back, 3)
                               : patch.at(0, back);
    }
    return curve;
}

Vec3 curve_position(const CubicCurve& curve, float t) {
    const Vec4 p = blend(curve, bernstein(t));
    return Vec3(p) / p.w;
}

CubicCurve reversed(const CubicCurve& curve) {
    return {curve[3], curve[2], curve[1], curve[0]};
}

Box hull(const CubicCurve& curve) {
    Box box;
    for (const Vec4& p : curve) box.add(Vec3(p) / p.w);
    return box;
}

Box hull(const BicubicPatch& patch) {
    Box box;
    for (const Vec4& p : patch.points) box.add(Vec3(p) / p.w);
    return box;
}

}  // namespace chiaro
