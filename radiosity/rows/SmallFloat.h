// Positive numbers in two bytes, for what there are tens of millions of.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace penumbra {

/// A number in [2^-28, 16): the upper bits of a float, without its sign and with an exponent of
/// five bits. What is smaller or larger is the least or the largest of them. Rounded to the nearest
/// one, off by 2^-12 of itself at most.
class SmallFloat {
public:
    constexpr SmallFloat() = default;
    explicit constexpr SmallFloat(float value) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(std::max(value, kLeast));
        bits_ = std::uint16_t(std::min((bits - kBase + kHalf) >> kDropped, 0xffffu));
    }
    constexpr operator float() const {
        return std::bit_cast<float>((std::uint32_t(bits_) << kDropped) + kBase);
    }

private:
    static constexpr int kDropped = 12; ///< bits of a float's mantissa
    static constexpr std::uint32_t kHalf = 1u << (kDropped - 1);
    static constexpr float kLeast = 0x1p-28f;
    static constexpr std::uint32_t kBase = std::bit_cast<std::uint32_t>(kLeast);

    std::uint16_t bits_ = 0;
};

} // namespace penumbra
