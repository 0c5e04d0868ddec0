// What a few rays found at single receivers, as it is likely to be around each of them.
#pragma once

#include "radiosity/mesh/PatchSet.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace penumbra {

/// How many of the receivers around one said yes, when each of some of a block was asked once: a
/// kernel-weighted mean [Nadaraya1964]. An answer counts the more the nearer it is and the more its
/// receiver faces the same way:
///
///     w = max(0, 1 - d^2 / (3 s^2))^2 * max(0, n . n')^2
///
/// where s is the spacing of the block's receivers: the root mean square distance between one and
/// the next, which lie beside each other mostly.
class KernelEstimate {
public:
    /// `receivers` must outlive this; at most 64.
    explicit KernelEstimate(std::span<const Receiver> receivers);

    /// Around one of the receivers, in [0, 1]; of the whole block if nobody near was asked, 0 if
    /// nobody was.
    /// \param asked, yes bits: receivers; what is not among `asked` does not count
    float at(std::size_t receiver, std::uint64_t asked, std::uint64_t yes) const;

private:
    std::span<const Receiver> receivers_;
    float perReach2_; ///< 1 / (3 s^2) [1/m^2]
};

} // namespace penumbra
