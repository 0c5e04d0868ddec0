#include "radiosity/schedule/PartialUpdate.h"

#include "base/Bits.h"

#include <algorithm>
#include <bit>

namespace penumbra {

namespace {

/// A part takes so many rays at least, unless no more are left: else visits take more time than
/// rays do.
constexpr double kLeastPart = 4 * cost::kProbedVisit;

float entryCost(const ExpectedFactors& expected, std::size_t receiver) {
    return cost::kProbedEntry + expected.rays[receiver];
}

} // namespace

void PartialUpdate::rank(std::uint64_t left, std::span<const float> gains, std::uint32_t view) {
    struct Ranked {
        float perCost;
        std::uint8_t receiver;
    };
    std::array<Ranked, ExpectedFactors::kSize> ranked;
    count_ = first_ = 0;
    for (const std::size_t i : bitsOf(left)) {
        ranked[count_++] = {gains[i] / entryCost(expected_, i), std::uint8_t(i)};
    }
    std::sort(ranked.begin(), ranked.begin() + std::ptrdiff_t(count_),
              [](const Ranked& a, const Ranked& b) {
                  return a.perCost != b.perCost ? a.perCost > b.perCost : a.receiver < b.receiver;
              });
    for (std::size_t i = 0; i < count_; ++i) {
        by_[i] = ranked[i].receiver;
        gain_[i] = gains[ranked[i].receiver];
    }
    view_ = view;
    ranked_ = true;
}

double PartialUpdate::cost(std::uint64_t receivers) const {
    double cost = cost::kProbedVisit;
    for (; receivers != 0; receivers &= receivers - 1)
        cost += entryCost(expected_, std::size_t(std::countr_zero(receivers)));
    return cost;
}

PartialUpdate::Part PartialUpdate::bestPart(bool whole) const {
    Part all, best;
    for (std::size_t i = first_; i < count_; ++i) {
        all.receivers |= std::uint64_t(1) << by_[i];
        all.gain += gain_[i];
        all.cost += entryCost(expected_, by_[i]);
        const bool few = best.cost < cost::kProbedVisit + kLeastPart;
        if (whole || few || all.gain * best.cost >= best.gain * all.cost) best = all;
    }
    return best;
}

void PartialUpdate::close(std::uint64_t part) {
    first_ += std::size_t(std::popcount(part));
}

} // namespace penumbra
