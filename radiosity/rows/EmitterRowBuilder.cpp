#include "radiosity/rows/EmitterRowBuilder.h"

#include "base/Bits.h"
#include "radiosity/rows/SenderSamples.h"

#include <algorithm>
#include <bit>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = ObjectId::kNone;
constexpr int kGroup = 16; ///< samples that are traced together

/// Samples that are always taken: all of a sender that fills much of the sky.
int firstSamples(const EmitterSender& sender, float formFactor) {
    return formFactor > 0.15f ? sender.allSamples() : sender.baseSamples();
}

} // namespace

/// The samples of an emitter and a receiver, gone through a group at a time.
struct EmitterRowBuilder::Pair {
    float weight[RowBlock::kSize];
    std::uint32_t blocker[RowBlock::kSize];
    std::uint64_t used = 0;

    void weigh(const SampleGroup& group, int first) {
        std::copy_n(group.weight, kGroup, weight + first);
        used |= std::uint64_t(group.rays.used) << first;
    }
    /// Takes a group's blockers from the record.
    void recall(const RowBlock::Draft& draft, int first) {
        for (int i = first; i < first + kGroup; ++i) blocker[i] = draft.blockerOf(i);
    }
    /// Takes what rays met. \return whether any sample is not what it was
    bool note(const ShadowRays& rays, int first) {
        bool changed = false;
        for (const int i : bitsOf(rays.used)) {
            changed |= blocker[first + i] != rays.blocker[i];
            blocker[first + i] = rays.blocker[i];
        }
        return changed;
    }
    /// \return bit i: sample first + i is visible
    std::uint32_t visible(int first) const {
        std::uint32_t lanes = 0;
        for (int i = 0; i < kGroup; ++i) lanes |= std::uint32_t(blocker[first + i] == kNone) << i;
        return lanes;
    }
    /// Whether of the first `count` samples some are visible and some are blocked.
    bool disagrees(int count) const {
        int states = 0;
        for (int i = 0; i < count; ++i)
            if (used >> i & 1) states |= blocker[i] == kNone ? 1 : 2;
        return states == 3;
    }
    /// Writes what the first `count` samples say. Sums run in the order of the samples.
    void write(int count, RowBlock::Draft& draft) const {
        float total = 0, seen = 0;
        draft.visible = 0;
        draft.blockerCount = 0;
        for (int i = 0; i < count; ++i) {
            if (!(used >> i & 1)) continue;
            total += weight[i];
            if (blocker[i] == kNone) {
                seen += weight[i];
                draft.visible |= std::uint64_t(1) << i;
            } else {
                draft.block(blocker[i], i);
            }
        }
        draft.visibility = draft.blockerCount == 0 ? 1.0f : total > 0 ? seen / total : 0.0f;
    }
};

void EmitterRowBuilder::trace(SampleGroup& group, int first, Pair& pair) {
    pair.weigh(group, first);
    if (group.rays.used == 0) return;
    rays_.occluded(group.rays);
    rayCount_.full += std::uint64_t(std::popcount(group.rays.used));
    std::copy_n(group.rays.blocker, kGroup, pair.blocker + first);
}

void EmitterRowBuilder::evaluate(const EmitterSender& sender, const Receiver& receiver,
                                 RowBlock::Draft& draft) {
    Pair pair;
    SampleGroup group;
    int count = firstSamples(sender, draft.formFactor);
    for (int first = 0; first < count; first += kGroup) {
        sender.sampleGroup(receiver, first, group);
        trace(group, first, pair);
        // More where the first ones disagree.
        if (first + kGroup == count && pair.disagrees(count)) count = sender.allSamples();
    }
    pair.write(count, draft);
}

int EmitterRowBuilder::samplesTaken(const EmitterSender& sender, const RowBlock::Draft& draft) {
    return draft.visible != 0 && draft.blockerCount != 0 ? sender.allSamples()
                                                         : firstSamples(sender, draft.formFactor);
}

/// Tests a group that is on record against what moved. \return whether any sample is another one
bool EmitterRowBuilder::retestGroup(std::span<const MovedObject> moved, int first, ShadowRays& rays,
                                    Pair& pair) {
    const std::uint32_t used = rays.used;
    std::uint32_t again = 0; // what moved had blocked
    for (const int i : bitsOf(used))
        again |= std::uint32_t(isAmong(moved, pair.blocker[first + i])) << i;
    std::uint32_t visible = used & pair.visible(first);
    bool changed = false;
    for (const MovedObject& m : moved) {
        if (!m.present || visible == 0) continue;
        rays.used = lanesThatMeet(rays, visible, m.box);
        if (rays.used == 0) continue;
        rays_.occludedBy({m.object}, rays);
        rayCount_.single += std::uint64_t(std::popcount(rays.used));
        changed |= pair.note(rays, first);
        visible &= pair.visible(first);
    }
    if (again == 0) return changed;
    rays.used = again;
    rays_.occluded(rays);
    rayCount_.full += std::uint64_t(std::popcount(again));
    return pair.note(rays, first) || changed;
}

bool EmitterRowBuilder::retest(const EmitterSender& sender, const Receiver& receiver,
                               std::span<const MovedObject> moved, RowBlock::Draft& draft) {
    if (!mayDiffer(draft, moved, receiver, sender.box())) return false;
    const int base = firstSamples(sender, draft.formFactor), all = sender.allSamples();
    const int taken = samplesTaken(sender, draft);
    Pair pair;
    SampleGroup group;
    bool changed = false;
    for (int first = 0; first < taken; first += kGroup) {
        sender.sampleGroup(receiver, first, group);
        pair.weigh(group, first);
        pair.recall(draft, first);
        changed |= retestGroup(moved, first, group.rays, pair);
    }
    if (!changed) return false;
    const bool more = pair.disagrees(base);
    for (int first = taken; more && first < all; first += kGroup) {
        sender.sampleGroup(receiver, first, group);
        trace(group, first, pair);
    }
    pair.write(more ? all : base, draft);
    return true;
}

int EmitterRowBuilder::update(const EmitterSender& sender, const ReceiverBlock& receivers,
                              std::uint64_t anew, std::span<const MovedObject> moved,
                              RowBlock& block) {
    const auto drafts = std::span(drafts_).first(receivers.receivers.size());
    block.decode(drafts);
    int changed = 0;
    for (std::size_t r = 0; r < drafts.size(); ++r) {
        RowBlock::Draft& draft = drafts[r];
        if (!(receivers.some >> r & 1)) continue;
        const bool before = draft.formFactor > 0, wanted = receivers.wanted >> r & 1;
        if (anew >> r & 1) {
            draft.begin(wanted ? sender.formFactor(receivers.receivers[r]) : 0.0f);
            if (draft.formFactor > 0) evaluate(sender, receivers.receivers[r], draft);
            changed += before || draft.formFactor > 0;
        } else if (before && !wanted) {
            draft.begin(0);
            ++changed;
        } else if (before) {
            changed += retest(sender, receivers.receivers[r], moved, draft);
        }
    }
    if (changed > 0) block.assign(drafts);
    return changed;
}

} // namespace penumbra
