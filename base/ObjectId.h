// The small integer that names a rigid piece of the scene.
#pragma once

#include <compare>
#include <cstdint>

namespace penumbra {

/// Index of an object: a rigid piece of the scene with one transform. Dense from 0.
struct ObjectId {
    std::uint32_t value = kNone;

    static constexpr std::uint32_t kNone = 0xffffffffu;
    constexpr bool valid() const { return value != kNone; }
    friend constexpr auto operator<=>(ObjectId, ObjectId) = default;
};

} // namespace penumbra
