#include "importance/OrderOfWork.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace penumbra {

namespace {

/// Changes count as they are, not by how well they are seen.
constexpr PlaceValue kLinear{1e-9, 1e9, false};

WorkQueue::Task taskFor(std::uint32_t place, double change, double cost) {
    WorkQueue::Task task;
    task.place = place;
    task.change = float(change);
    task.cost = float(cost);
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

WorkQueue::Task PlainOrder::rank(const BlockOfWork& work) const {
    return taskFor(work.row, 1, 1);
}
PlaceValue PlainOrder::value(std::uint32_t place) const {
    return {double(std::numeric_limits<std::uint32_t>::max() - place), 1, true};
}

WorkQueue::Task BoundOrder::rank(const BlockOfWork& work) const {
    return taskFor(0, work.bound, work.cost);
}
PlaceValue BoundOrder::value(std::uint32_t) const {
    return kLinear;
}

WorkQueue::Task RandomOrder::rank(const BlockOfWork& work) const {
    const std::uint64_t key = std::uint64_t(work.row) << 32 | work.block;
    return taskFor(0, double(mixed(key ^ std::uint64_t(seed_) << 16) >> 8), 1);
}
PlaceValue RandomOrder::value(std::uint32_t) const {
    return kLinear;
}

WorkQueue::Task ImportanceOrder::rank(const BlockOfWork& work) const {
    // A block that has come since then is of something small: its place is behind all others.
    const bool known =
        work.block < placeOf_.size() && placeOf_[work.block] != PlaceClusters::kNowhere;
    const auto none = std::uint32_t(placeOf_.size());
    return taskFor(known ? placeOf_[work.block] : none, work.bound / std::numbers::pi, work.cost);
}
PlaceValue ImportanceOrder::value(std::uint32_t place) const {
    if (place >= placeOf_.size()) return {1e-12, 1, false};
    const Sight sight = look_(place);
    return placeValue(sight.place, attention_, sight.seen);
}

} // namespace penumbra
