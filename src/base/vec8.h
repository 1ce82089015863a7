// Vectors of eight places or colours side by side, and the way from structs in memory to them.
#pragma once

#include "base/vec.h"
#include "base/wide.h"

#include <algorithm>
#include <span>

namespace chiaro {

struct Vec2x8 {
    Float8 x, y;
};
struct Vec3x8 {
    Float8 x, y, z;
};
inline Vec3x8 everywhere(Vec3 v) {
    return {v.x, v.y, v.z};
}
inline Vec3x8 operator+(const Vec3x8& a, const Vec3x8& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3x8 operator-(const Vec3x8& a, const Vec3x8& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3x8 operator*(const Vec3x8& a, const Vec3x8& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Vec3x8 operator*(Float8 a, const Vec3x8& v) {
    return {a * v.x, a * v.y, a * v.z};
}
inline Float8 dot(const Vec3x8& a, const Vec3x8& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float8 max_component(const Vec3x8& v) {
    return larger(v.x, larger(v.y, v.z));
}
/// The largest coordinate, whatever its sign. For Vec3 and Vec3x8.
template <typename Vector>
auto largest(const Vector& v) {
    using std::abs;
    return larger(abs(v.x), larger(abs(v.y), abs(v.z)));
}
inline Vec3x8 select(Mask8 first, const Vec3x8& a, const Vec3x8& b) {
    return {select(first, a.x, b.x), select(first, a.y, b.y), select(first, a.z, b.z)};
}

/// Three numbers a lane, to be read and written lane by lane.
struct Lanes3 {
    alignas(32) float x[kLanes], y[kLanes], z[kLanes];

    explicit Lanes3(const Vec3x8& v = {0, 0, 0}) {
        v.x.store(x);
        v.y.store(y);
        v.z.store(z);
    }
    Vec3 lane(int i) const { return {x[i], y[i], z[i]}; }
    void set(int i, Vec3 v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    Vec3x8 all() const { return {load8(x), load8(y), load8(z)}; }
};

/// Row i becomes lane i of all eight: its own inverse.
inline void transpose(Float8 (&r)[kLanes]) {
    __m256 pairs[kLanes], fours[kLanes];
    for (int i = 0; i < kLanes; i += 2) {
        pairs[i] = _mm256_unpacklo_ps(r[i].value, r[i + 1].value);
        pairs[i + 1] = _mm256_unpackhi_ps(r[i].value, r[i + 1].value);
    }
    for (int i = 0; i < kLanes; i += 4) {
        fours[i] = _mm256_shuffle_ps(pairs[i], pairs[i + 2], 0x44);
        fours[i + 1] = _mm256_shuffle_ps(pairs[i], pairs[i + 2], 0xee);
        fours[i + 2] = _mm256_shuffle_ps(pairs[i + 1], pairs[i + 3], 0x44);
        fours[i + 3] = _mm256_shuffle_ps(pairs[i + 1], pairs[i + 3], 0xee);
    }
    for (int i = 0; i < kLanes / 2; ++i) {
        r[i] = _mm256_permute2f128_ps(fours[i], fours[i + 4], 0x20);
        r[i + 4] = _mm256_permute2f128_ps(fours[i], fours[i + 4], 0x31);
    }
}

/// The eight words from word `first` on of each of up to eight structs, word by word; the last one
/// stands for those that are not there. Words of any kind come as the bits of floats.
template <typename T>
void load_words(std::span<const T> structs, std::size_t first, Float8 (&words)[kLanes]) {
    const auto* const base = reinterpret_cast<const float*>(structs.data()) + first;
    for (std::size_t i = 0; i < kLanes; ++i)
        words[i] = load8(base + std::min(i, structs.size() - 1) * (sizeof(T) / sizeof(float)));
    transpose(words);
}

/// Its inverse, for eight structs.
template <typename T>
void store_words(Float8 (&words)[kLanes], T* structs) {
    transpose(words);
    auto* const base = reinterpret_cast<float*>(structs);
    for (std::size_t i = 0; i < kLanes; ++i) words[i].store(base + i * (sizeof(T) / sizeof(float)));
}

}  // namespace chiaro
