// How far a block of a row comes from what it was.
#pragma once

#include "radiosity/Row.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace penumbra {

/// Remembers F V of the receivers of a block, to tell what becomes of it.
class ChangeOfBlock {
public:
    explicit ChangeOfBlock(const RowBlock& block) { add(block, 1); }

    /// The sum over the receivers of how far F V changed, up or down. \post of no further use
    float upTo(const RowBlock& block) {
        add(block, -1);
        float sum = 0;
        for (const float change : change_) sum += std::abs(change);
        return sum;
    }

private:
    void add(const RowBlock& block, float sign) {
        block.forEach([&](int r, float factor) { change_[std::size_t(r)] += sign * factor; });
    }
    std::array<float, RowBlock::kSize> change_{};
};

} // namespace penumbra
