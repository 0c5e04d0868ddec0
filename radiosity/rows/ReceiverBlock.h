// Receivers that a row is built for, a block at a time.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstdint>
#include <span>

namespace penumbra {

/// Up to 64 receivers of one block.
struct ReceiverBlock {
    std::span<const Receiver> receivers;
    std::uint64_t wanted = ~std::uint64_t(0); ///< bits: receivers that may have an entry
    std::span<const std::uint32_t> keys = {}; ///< addresses, see PatchSet.h; not of vertices
    std::uint64_t some = ~std::uint64_t(0);   ///< bits: of which entries are brought up to date
};

} // namespace penumbra
