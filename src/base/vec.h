// Vectors, rays and boxes. Space is right-handed; lengths are in scene units (metres in glTF).
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <type_traits>

namespace chiaro {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat3 = glm::mat3;
using Mat4 = glm::mat4;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kPi = 3.14159265358979323846f;

/// Half line from `origin` along `direction`, which need not be of unit length; distances along it
/// are in multiples of `direction`. Valid between `t_min` and `t_max`.
struct Ray {
    Vec3 origin = Vec3(0);
    Vec3 direction = Vec3(0, 0, 1);
    float t_min = 0;
    float t_max = kInfinity;
};

/// Axis-aligned box; empty until something is added to it.
struct Box {
    Vec3 low = Vec3(kInfinity);
    Vec3 high = Vec3(-kInfinity);

    bool empty() const { return low.x > high.x; }
    Vec3 centre() const { return 0.5f * (low + high); }
    float diagonal() const { return empty() ? 0.0f : glm::length(high - low); }
    void add(Vec3 p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Box& b) {
        low = glm::min(low, b.low);
        high = glm::max(high, b.high);
    }
};

/// `v` of the frame whose third axis is the unit vector `n`, in the space of `n`; right-handed
/// (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017). For Vec3 and Vec3x8.
template <typename Vector>
Vector from_frame(const Vector& n, const Vector& v) {
    using std::copysign;
    using Number = std::remove_cvref_t<decltype(n.x)>;
    const auto sign = copysign(Number(1), n.z);
    const auto a = Number(-1) / (sign + n.z);
    const auto b = n.x * n.y * a;
    const auto along_s = v.x, along_t = v.y;
    return {along_s * (Number(1) + sign * n.x * n.x * a) + along_t * b + v.z * n.x,
            along_s * sign * b + along_t * (sign + n.y * n.y * a) + v.z * n.y,
            v.z * n.z - along_s * sign * n.x - along_t * n.y};
}

/// The same frame, to go both ways.
struct Frame {
    Vec3 s, t, n;
    explicit Frame(Vec3 normal)
        : s(from_frame(normal, Vec3(1, 0, 0))), t(from_frame(normal, Vec3(0, 1, 0))), n(normal) {}
    Vec3 to_world(Vec3 v) const { return v.x * s + v.y * t + v.z * n; }
    Vec3 to_local(Vec3 v) const { return {glm::dot(s, v), glm::dot(t, v), glm::dot(n, v)}; }
};

/// The factor by which lengths grow at most; where axes do not stay at right angles, up to 1.8
/// times as much.
inline float largest_stretch(const Mat4& affine) {
    const Vec3 x(affine[0]), y(affine[1]), z(affine[2]);
    const float xx = glm::dot(x, x), yy = glm::dot(y, y), zz = glm::dot(z, z);
    const float most = glm::max(glm::max(xx, yy), zz);
    const float skew = glm::max(glm::max(std::abs(glm::dot(x, y)), std::abs(glm::dot(y, z))),
                                std::abs(glm::dot(z, x)));
    return std::sqrt(skew <= 1e-5f * most ? most : xx + yy + zz);
}

inline bool is_finite(Vec3 v) {
    const float sum = v.x + v.y + v.z;
    return sum - sum == 0.0f;
}

}  // namespace chiaro
