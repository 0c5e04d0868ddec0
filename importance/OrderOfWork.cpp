#include "importance/OrderOfWork.h"

#include "importance/ContrastSensitivity.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <numbers>

namespace penumbra {

namespace {

/// Changes count as they are, not by how well they are seen.
constexpr PlaceValue kLinear{1e-9, 1e9, false};

WorkQueue::Task taskFor(std::uint32_t place, double change, double cost) {
    WorkQueue::Task task;
    task.place = place;
    task.worth.change = float(change);
    task.worth.cost = float(cost);
    return task;
}

/// Finalisation mix of MurmurHash3 (Appleby, public domain): all bits of the result depend on all
/// of x.
std::uint32_t mixed(std::uint64_t x) {
    x = (x ^ x >> 33) * 0xff51afd7ed558ccdULL;
    x = (x ^ x >> 33) * 0xc4ceb9fe1a85ec53ULL;
    return std::uint32_t(x >> 32);
}

} // namespace

void OrderOfWork::gains(const BlockOfWork&, std::span<const float> change,
                        std::span<float> gains) const {
    std::copy(change.begin(), change.end(), gains.begin());
}

WorkQueue::Task PlainOrder::rank(const BlockOfWork& work) const {
    return taskFor(work.row, 1, 1);
}
PlaceValue PlainOrder::value(std::uint32_t place) const {
    return {double(std::numeric_limits<std::uint32_t>::max() - place), 1, true};
}

WorkQueue::Task BoundOrder::rank(const BlockOfWork& work) const {
    // Worths of about the same size make a place, so that few tasks need be sorted at a time:
    // exponent and first two bits of the fraction.
    const auto worth = float(work.bound / work.cost);
    return taskFor(std::bit_cast<std::uint32_t>(worth) >> 21, work.bound, work.cost);
}
PlaceValue BoundOrder::value(std::uint32_t) const {
    return kLinear;
}

WorkQueue::Task RandomOrder::rank(const BlockOfWork& work) const {
    const std::uint64_t key = std::uint64_t(work.row) << 32 | work.block;
    const std::uint32_t lot = mixed(key ^ std::uint64_t(seed_) << 16) >> 8;
    return taskFor(lot >> 16, double(lot), 1); // places as of BoundOrder
}
PlaceValue RandomOrder::value(std::uint32_t) const {
    return kLinear;
}

WorkQueue::Task ImportanceOrder::rank(const BlockOfWork& work) const {
    // What has no place of its own belongs to several: all of that counts as one more.
    const bool known =
        work.block < placeOf_.size() && placeOf_[work.block] != PlaceClusters::kNowhere;
    const auto none = std::uint32_t(placeOf_.size());
    return taskFor(known ? placeOf_[work.block] : none, work.bound * std::numbers::inv_pi,
                   work.cost);
}
void ImportanceOrder::gains(const BlockOfWork& work, std::span<const float> change,
                            std::span<float> gains) const {
    std::array<PlaceValue, 64> values;
    assert(change.size() <= values.size());
    std::uint64_t which = 0;
    for (std::size_t r = 0; r < change.size(); ++r) which |= std::uint64_t(change[r] > 0) << r;
    closeLook_(work.block, which, values);
    for (std::size_t r = 0; r < change.size(); ++r)
        gains[r] = float(workValue(values[r], double(change[r]) * std::numbers::inv_pi, 1));
}
PlaceValue ImportanceOrder::value(std::uint32_t place) const {
    if (!attention_) return {1e-12, 1, false};
    if (place >= placeOf_.size()) return averageValue();
    const Sight sight = look_(place);
    return placeValue(sight.place, *attention_, sight.seen);
}

/// Of a place in the picture, if a quarter of all is.
PlaceValue ImportanceOrder::averageValue() const {
    PlaceValue value;
    const double places = std::max(1.0, double(placeOf_.size()) / 4);
    value.weight = attention_->factors.size ? attention_->viewpoint.pixels() / places : 1;
    value.anyChange = !attention_->factors.change;
    if (attention_->factors.contrast)
        value.perThreshold =
            peakContrastSensitivity(attention_->adaptation) / attention_->adaptation;
    return value;
}

} // namespace penumbra
