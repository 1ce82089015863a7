// The random numbers of one seed: rotated Halton points for what every sample does first, hashes
// for what few samples get to. Nothing but (seed, sample, dimension) decides a number.
#pragma once

#include "base/halton.h"
#include "base/random.h"
#include "base/vec8.h"
#include "sample_renderer/sample_renderer.h"

#include <array>

namespace chiaro {

/// Uses of the Halton dimensions along a path, lowest bases to what matters most. The first
/// direction is found by the cosine at a point, by the place in a pixel from the eye.
/// The place in the environment is that on a light, rotated differently.
enum PathDimension : int {
    kFirstDirection = 0,
    kFirstLightPlace = 2,
    kFirstLightChoice = 4,
    kFirstSkyRotation = 5,
    kEmission = 5  // the direction in which a walk leaves a light
};

/// Uses of the dimensions in direct light; the two direction numbers have a sequence of their own,
/// and the place in the environment is that on a light, rotated differently.
enum DirectDimension : int {
    kLightPlace = 0,
    kLightChoice = 2,
    kLightDirection = 3,
    kSkyRotation = 5
};

/// Whether sample `index` of a replicate takes a turn that one in `every` takes: a random one of
/// each block, so that any range of samples is unbiased, and any that holds whole blocks has
/// exactly its share.
inline bool takes_turn(std::uint32_t seed, std::uint32_t replicate, std::uint32_t index,
                       std::uint32_t every) {
    const std::uint32_t turn = hash32(hash32(seed, 0x7a1eU + replicate), index / every) >> 16;
    return index % every == turn % every;
}

/// The rotated Halton sequence of one seed, in kReplicates independent copies.
class Sequence {
public:
    explicit Sequence(std::uint32_t seed) : seed_(seed), table_(table()) {
        for (std::uint32_t r = 0; r < kReplicates; ++r)
            for (std::uint32_t d = 0; d < kDimensions; ++d)
                rotations_[r][d] = to_unit_float(hash32(seed, 0x5eed'0000U + 16 * r + d));
    }

    /// Number of `sample` in `dimension`, in [0, 1).
    float number(std::uint32_t sample, int dimension) const {
        return rotated(sample % kReplicates, dimension, dimension, sample / kReplicates);
    }
    Vec2 pair(std::uint32_t sample, int dimension) const {
        return {number(sample, dimension), number(sample, dimension + 1)};
    }

    /// The pair with the rotations of `rotation` and the next (up to 6) instead: as well spread,
    /// for another light. Of lights that add up, each is integrated as well as by itself.
    Vec2 rotated_pair(std::uint32_t sample, int dimension, int rotation) const {
        const std::uint32_t replicate = sample % kReplicates, index = sample / kReplicates;
        return {rotated(replicate, dimension, rotation, index),
                rotated(replicate, dimension + 1, rotation + 1, index)};
    }

    /// Point `index` of the two lowest bases, with the rotations of `dimension` and the next: a
    /// second sequence for what only some samples do, so that those few are spread well by
    /// themselves.
    Vec2 sparse_pair(std::uint32_t replicate, std::uint32_t index, int dimension) const {
        return {rotated(replicate, 0, dimension, index),
                rotated(replicate, 1, dimension + 1, index)};
    }

    /// Names the numbers of `sample` beyond the Halton dimensions.
    std::uint32_t key(std::uint32_t sample) const { return hash32(hash32(seed_, 0x9a7bU), sample); }

private:
    static constexpr int kDimensions = 7;

    float rotated(std::uint32_t replicate, int base, int dimension, std::uint32_t index) const {
        const float point = index < kTableSize ? table_[base][index] : halton(base, index);
        return rotate_unit(point, rotations_[replicate][dimension]);
    }

    // The first points once more, where they need no call.
    static constexpr std::uint32_t kTableSize = 1024;
    using Table = std::array<std::array<float, kTableSize>, kDimensions>;
    static const Table& table();
    std::uint32_t seed_;
    const Table& table_;
    std::array<std::array<float, kDimensions>, kReplicates> rotations_;
};

/// The numbers at one bounce of the path that `key` names, in order; and of eight paths.
class BounceNumbers {
public:
    BounceNumbers(std::uint32_t key, std::uint32_t bounce) : state_(hash32(key, bounce)) {}
    float next() { return to_unit_float(hash32(state_ += 0x9e37'79b9U)); }
    Vec2 next_pair() {
        const float first = next();
        return {first, next()};
    }

private:
    std::uint32_t state_;
};
class BounceNumbers8 {
public:
    BounceNumbers8(Word8 keys, std::uint32_t bounce) : state_(mixed_bits(keys, Word8(bounce))) {}
    Float8 next() {
        state_ = state_ + Word8(0x9e37'79b9U);
        return to_float(mixed_bits(state_) >> 8) * Float8(0x1p-24f);
    }
    Vec2x8 next_pair() {
        const Float8 first = next();
        return {first, next()};
    }

private:
    Word8 state_;
};

}  // namespace chiaro
