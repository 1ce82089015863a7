#include "scene/bicubic.h"

#include <algorithm>
#include <utility>

namespace chiaro {
namespace {

// Bernstein polynomials of degree 3 and their derivatives.
std::array<float, 4> bernstein(float t) {
    const float s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}
std::array<float, 4> bernstein_slopes(float t) {
    const float s = 1 - t;
    return {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
}

Vec4 blend(const BicubicPatch& patch, const std::array<float, 4>& u,
           const std::array<float, 4>& v) {
    Vec4 sum(0);
    for (int j = 0; j < 4; ++j)
        sum += v[j] * (u[0] * patch.at(0, j) + u[1] * patch.at(1, j) + u[2] * patch.at(2, j) +
                       u[3] * patch.at(3, j));
    return sum;
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
    const auto u = bernstein(uv.x), v = bernstein(uv.y);
    const Vec4 p = blend(patch, u, v);
    const Vec4 du = blend(patch, bernstein_slopes(uv.x), v);
    const Vec4 dv = blend(patch, u, bernstein_slopes(uv.y));
    const Vec3 place = Vec3(p) / p.w;
    return {place, (Vec3(du) - du.w * place) / p.w, (Vec3(dv) - dv.w * place) / p.w};
}

Vec3 patch_position(const BicubicPatch& patch, Vec2 uv) {
    const Vec4 p = blend(patch, bernstein(uv.x), bernstein(uv.y));
    return Vec3(p) / p.w;
}

Vec3 patch_normal(const BicubicPatch& patch, Vec2 uv) {
    // The cross product is lost in rounding where it is this small a part of what it could be.
    constexpr float kLost = 1e-5f;
    const Box box = hull(patch);
    const float enough = kLost * box.diagonal() * box.diagonal();
    for (const float inward : {0.0f, 1e-3f, 1e-2f, 0.1f, 0.5f}) {
        const PatchPoint p = patch_point(patch, glm::mix(uv, Vec2(0.5f), inward));
        const Vec3 cross = glm::cross(p.du, p.dv);
        const float length = glm::length(cross);
        if (length > enough) return cross / length;
    }
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
    const auto b = bernstein(t);
    const Vec4 p = b[0] * curve[0] + b[1] * curve[1] + b[2] * curve[2] + b[3] * curve[3];
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
