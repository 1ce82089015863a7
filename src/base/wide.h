// Eight numbers side by side in one register of AVX2: arithmetic on all of them costs what it costs
// on one. What is written as a template runs on single numbers too.
#pragma once

#include <immintrin.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace chiaro {

inline constexpr int kLanes = 8;

/// Yes or no for each lane.
struct Mask8 {
    __m256 bits;  // all or none of a lane's are set

    /// Bit i: of lane i.
    unsigned lanes() const { return static_cast<unsigned>(_mm256_movemask_ps(bits)); }
};
inline Mask8 operator&(Mask8 a, Mask8 b) {
    return {_mm256_and_ps(a.bits, b.bits)};
}

/// Calls each(i) for each bit i that is set, in rising order.
template <typename Each>
void for_each_lane(unsigned lanes, const Each& each) {
    for (; lanes != 0; lanes &= lanes - 1) each(std::countr_zero(lanes));
}

struct Float8 {
    __m256 value;

    Float8() = default;
    Float8(__m256 v) : value(v) {}
    Float8(float everywhere) : value(_mm256_set1_ps(everywhere)) {}
    void store(float* eight) const { _mm256_storeu_ps(eight, value); }
};
inline Float8 load8(const float* eight) {
    return _mm256_loadu_ps(eight);
}
inline Float8 operator+(Float8 a, Float8 b) {
    return _mm256_add_ps(a.value, b.value);
}
inline Float8 operator-(Float8 a, Float8 b) {
    return _mm256_sub_ps(a.value, b.value);
}
inline Float8 operator*(Float8 a, Float8 b) {
    return _mm256_mul_ps(a.value, b.value);
}
inline Float8 operator/(Float8 a, Float8 b) {
    return _mm256_div_ps(a.value, b.value);
}
inline Mask8 operator<(Float8 a, Float8 b) {
    return {_mm256_cmp_ps(a.value, b.value, _CMP_LT_OQ)};
}
inline Mask8 operator>(Float8 a, Float8 b) {
    return b < a;
}
inline Mask8 operator<=(Float8 a, Float8 b) {
    return {_mm256_cmp_ps(a.value, b.value, _CMP_LE_OQ)};
}
/// Lanes 0 to count - 1.
inline Mask8 first_lanes(std::size_t count) {
    const __m256i numbers = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i limit = _mm256_set1_epi32(static_cast<int>(count < kLanes ? count : kLanes));
    return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(limit, numbers))};
}
inline Float8 sqrt(Float8 a) {
    return _mm256_sqrt_ps(a.value);
}
inline Float8 abs(Float8 a) {
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.value);
}
inline Float8 copysign(Float8 size, Float8 sign) {
    const __m256 bit = _mm256_set1_ps(-0.0f);
    return _mm256_or_ps(_mm256_andnot_ps(bit, size.value), _mm256_and_ps(bit, sign.value));
}
/// The larger and the smaller; `b` if `a` is a NaN.
inline Float8 larger(Float8 a, Float8 b) {
    return _mm256_max_ps(a.value, b.value);
}
inline Float8 smaller(Float8 a, Float8 b) {
    return _mm256_min_ps(a.value, b.value);
}
inline float larger(float a, float b) {
    return a > b ? a : b;
}
/// `a` where `first`, else `b`.
inline Float8 select(Mask8 first, Float8 a, Float8 b) {
    return _mm256_blendv_ps(b.value, a.value, first.bits);
}

/// Unsigned integers of 32 bits; they wrap around.
struct Word8 {
    __m256i value;

    Word8(__m256i v) : value(v) {}
    Word8(std::uint32_t everywhere) : value(_mm256_set1_epi32(static_cast<int>(everywhere))) {}
};
inline Word8 operator+(Word8 a, Word8 b) {
    return _mm256_add_epi32(a.value, b.value);
}
inline Word8 operator*(Word8 a, Word8 b) {
    return _mm256_mullo_epi32(a.value, b.value);
}
inline Word8 operator^(Word8 a, Word8 b) {
    return _mm256_xor_si256(a.value, b.value);
}
inline Word8 operator>>(Word8 a, int bits) {
    return _mm256_srli_epi32(a.value, bits);
}
inline Word8 operator<<(Word8 a, int bits) {
    return _mm256_slli_epi32(a.value, bits);
}
/// The same bits, and the nearest numbers of those below 2^31.
inline Word8 bits_of(Float8 a) {
    return _mm256_castps_si256(a.value);
}
inline Float8 to_float(Word8 a) {
    return _mm256_cvtepi32_ps(a.value);
}

}  // namespace chiaro
