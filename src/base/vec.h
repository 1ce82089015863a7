// Vectors, rays and boxes. Space is right-handed; lengths are in scene units (metres in glTF).
#pragma once

#include <glm/glm.hpp>
#include <limits>

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

/// Two unit vectors that form a right-handed frame with the unit vector `n` as third axis
/// (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
struct Frame {
    Vec3 s, t, n;
    explicit Frame(Vec3 normal) : n(normal) {
        const float sign = n.z < 0 ? -1.0f : 1.0f;
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        s = Vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
        t = Vec3(b, sign + n.y * n.y * a, -n.y);
    }
    Vec3 to_world(Vec3 v) const { return v.x * s + v.y * t + v.z * n; }
    Vec3 to_local(Vec3 v) const { return {glm::dot(s, v), glm::dot(t, v), glm::dot(n, v)}; }
};

inline bool is_finite(Vec3 v) {
    const float sum = v.x + v.y + v.z;
    return sum - sum == 0.0f;
}

}  // namespace chiaro
