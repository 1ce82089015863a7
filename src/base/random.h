// Random numbers whose seed is always explicit: one seed, one picture, on any number of threads.
#pragma once

#include <cstdint>

namespace chiaro {

/// hash32() of words of 32 bits, or of eight side by side (base/wide.h).
template <typename Word>
Word mixed_bits(Word x) {
    x = x ^ (x >> 16);
    x = x * Word(0x7feb352dU);
    x = x ^ (x >> 15);
    x = x * Word(0x846ca68bU);
    return x ^ (x >> 16);
}
template <typename Word>
Word mixed_bits(Word a, Word b) {
    return mixed_bits(a ^ (mixed_bits(b) + Word(0x9e3779b9U) + (a << 6) + (a >> 2)));
}

/// Mixes 32 bits so that every input bit affects every output bit ("lowbias32", C. Wellons 2018).
inline std::uint32_t hash32(std::uint32_t x) {
    return mixed_bits(x);
}
inline std::uint32_t hash32(std::uint32_t a, std::uint32_t b) {
    return mixed_bits(a, b);
}

inline std::uint32_t hash64(std::uint64_t x) {
    return hash32(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(x >> 32));
}

/// A session's seed as renderers take it; those below 2^32 are themselves.
inline std::uint32_t short_seed(std::uint64_t seed) {
    return seed >> 32 == 0 ? static_cast<std::uint32_t>(seed) : hash64(seed);
}

/// The 24 high bits of `bits` as a float in [0, 1).
inline float to_unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// A small generator: 64-bit state, 32-bit output (PCG-XSH-RR, O'Neill 2014).
class Rng {
public:
    explicit Rng(std::uint64_t seed, std::uint64_t stream = 0)
        : state_(0), increment_((stream << 1) | 1) {
        next();
        state_ += seed;
        next();
    }
    std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ULL + increment_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
        const auto rotation = static_cast<std::uint32_t>(old >> 59);
        return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
    }
    /// Uniform in [0, 1).
    float uniform() { return to_unit_float(next()); }
    /// Uniform in [0, bound); bound > 0.
    std::uint32_t below(std::uint32_t bound) {
        return static_cast<std::uint32_t>((static_cast<std::uint64_t>(next()) * bound) >> 32);
    }

private:
    std::uint64_t state_;
    std::uint64_t increment_;
};

}  // namespace chiaro
