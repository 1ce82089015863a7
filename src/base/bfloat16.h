// Half the bits of a float, for numbers of which many are kept and few digits matter.
#pragma once

#include <bit>
#include <cstdint>

namespace chiaro {

/// The upper half of a float: its range, and 8 significant bits (steps of 0.4 to 0.8 %).
class Bfloat16 {
public:
    Bfloat16() = default;
    /// Rounds to nearest; infinities stay.
    Bfloat16(float value)
        : bits_(static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(value) + 0x7fffU +
                                            (std::bit_cast<std::uint32_t>(value) >> 16 & 1)) >>
                                           16)) {}
    operator float() const { return std::bit_cast<float>(static_cast<std::uint32_t>(bits_) << 16); }

private:
    std::uint16_t bits_ = 0;
};

}  // namespace chiaro
