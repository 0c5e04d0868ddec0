// What a probe found in a dirty block, and which of its receivers come first because of it.
#pragma once

#include "radiosity/schedule/WorkCosts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace penumbra {

/// What to expect of the entries of a block.
struct ExpectedFactors {
    static constexpr std::size_t kSize = 64;

    std::uint64_t dirty = 0;           ///< bits: entries that may change at all
    std::array<float, kSize> factor{}; ///< by how much F V changes, more or less
    std::array<float, kSize> rays{};   ///< that it takes to find out
};

/// A probed block is done in parts: of the receivers that are left, in the order of
/// what is gained at each per ray, as many as make the most of a visit,
///
///     max over n of (gain_1 + ... + gain_n) / (visit + rays_1 + ... + rays_n)
///
/// come first, and the rest has the priority of the next such part.
class PartialUpdate {
public:
    explicit PartialUpdate(const ExpectedFactors& expected) : expected_(expected) {}

    const ExpectedFactors& expected() const { return expected_; }

    /// Whether its receivers are in order, as the viewer sees them.
    bool isRanked(std::uint32_t view) const { return ranked_ && view_ == view; }
    /// Puts receivers in order. \param left bits: those that are left \param gains one a receiver
    /// \param view see SchedulingPolicy::view()
    void rank(std::uint64_t left, std::span<const float> gains, std::uint32_t view);
    /// They are to be put in order again.
    void unrank() { ranked_ = false; }

    /// What working on some receivers (bits) of such a block costs, about [rays].
    double cost(std::uint64_t receivers) const;
    struct Part {
        std::uint64_t receivers = 0; ///< bits
        double gain = 0;
        double cost = cost::kProbedVisit; ///< [rays]
    };
    /// What comes next. \pre they are in order \param whole all that is left
    Part bestPart(bool whole) const;
    /// The best part is done.
    void close(std::uint64_t part);

private:
    ExpectedFactors expected_;
    std::uint32_t view_ = 0;
    std::size_t count_ = 0; ///< receivers that were left when they were put in order,
    std::size_t first_ = 0; ///< of which these are done
    std::array<std::uint8_t, ExpectedFactors::kSize> by_; ///< the best per cost first
    std::array<float, ExpectedFactors::kSize> gain_;      ///< likewise
    bool ranked_ = false;
};

} // namespace penumbra
