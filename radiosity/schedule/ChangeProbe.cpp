#include "radiosity/schedule/ChangeProbe.h"

#include "base/Bits.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace penumbra {

namespace {

/// What rays may have missed: this share of F changes whatever they say, and of entries that are
/// evaluated anew, of which few have a ray of their own, this one.
constexpr float kLeastShare = 0.01f, kLeastShareAnew = 0.1f;
/// Of entries that are evaluated anew, one in so many has a ray.
constexpr std::size_t kAnewGroup = 8;
/// Rays of an entry in half-shadow for its further samples, as it may be one.
constexpr float kFurther = 8;

float weightOf(const SampleGroup& group, std::uint32_t lanes) {
    float sum = 0;
    for (; lanes != 0; lanes &= lanes - 1) sum += group.weight[std::countr_zero(lanes)];
    return sum;
}

/// One of some lanes; another one for each receiver, as likely as any.
int oneOf(std::uint32_t lanes, std::size_t receiver) {
    constexpr std::size_t kStep = 23; // has no divisor in common with any number of lanes
    const int place = int(kStep * receiver + 3) % std::popcount(lanes);
    for (int i = 0; i < place; ++i) lanes &= lanes - 1;
    return std::countr_zero(lanes);
}

/// Receivers (bits) of which one is asked.
std::uint64_t groupOf(std::size_t receiver) {
    constexpr std::uint64_t kAll = (std::uint64_t(1) << kAnewGroup) - 1;
    return kAll << receiver / kAnewGroup * kAnewGroup;
}

/// Samples that point at where moved objects are now.
std::uint32_t lanesTowards(const SampleGroup& group, std::span<const MovedObject> moved) {
    std::uint32_t met = 0;
    for (const MovedObject& m : moved)
        if (m.present) met |= lanesThatMeet(group.rays, group.rays.used, m.box);
    return met;
}

float visibilityOf(const RowBlock::Draft& draft) {
    if (draft.blockerCount == 0) return 1;
    return draft.visible != 0 ? draft.visibility : 0.0f;
}

} // namespace

ExpectedFactors ChangeProbe::at(const EmitterSender& sender, const ReceiverBlock& receivers,
                                std::uint64_t anew, std::span<const MovedObject> moved,
                                const RowBlock& block) {
    block.decode(std::span(drafts_).first(receivers.receivers.size()));
    ExpectedFactors expected;
    probes_.fill({});
    stored_ = anew_ = fresh_ = {};
    for (std::size_t r = 0; r < receivers.receivers.size(); ++r) {
        const Receiver& receiver = receivers.receivers[r];
        if (!(receivers.some >> r & 1) || (isPadding(receiver) && !(anew >> r & 1))) continue;
        float& rays = expected.rays[r];
        const bool stays = !(anew >> r & 1) && receivers.wanted >> r & 1;
        const bool dirty = stays ? probeStored(sender, receiver, r, moved, rays)
                                 : probeAnew(sender, receivers, r, rays);
        expected.dirty |= std::uint64_t(dirty) << r;
    }
    trace(alone_, moved);
    trace(whole_, {});
    const KernelEstimate share(receivers.receivers);
    for (std::size_t r = 0; r < receivers.receivers.size(); ++r) {
        const Probe& probe = probes_[r];
        const bool isAnew = anew >> r & 1;
        const Answers& answers = !isAnew ? stored_ : drafts_[r].formFactor > 0 ? anew_ : fresh_;
        const float least = isAnew ? kLeastShareAnew : kLeastShare;
        expected.factor[r] = std::max(std::abs(changeOf(r, answers, share)),
                                      least * std::max(probe.now, probe.before));
    }
    return expected;
}

/// Of F V, up or down. What happened to rays happens to as many of the samples around them.
float ChangeProbe::changeOf(std::size_t r, const Answers& answers,
                            const KernelEstimate& share) const {
    const Probe& probe = probes_[r];
    const auto blocked = [&](const Asked& asked) { return share.at(r, asked.all, asked.blocked); };
    const float visible = probe.visible + probe.uncovered * (1 - blocked(answers.uncovered)) -
                          probe.covered * blocked(answers.covered);
    return probe.now * visible - probe.before;
}

ChangeProbe::Recorded ChangeProbe::recordedIn(const RowBlock::Draft& draft,
                                              std::span<const MovedObject> moved) const {
    Recorded recorded;
    for (int b = 0; b < draft.blockerCount; ++b) {
        const Blocker& blocker = draft.blockers[std::size_t(b)];
        (isAmong(moved, blocker.object) ? recorded.byMoved : recorded.byOthers) |= blocker.samples;
    }
    return recorded;
}

/// Whether moved objects may cover any of the samples after the first group.
bool ChangeProbe::coversFurther(const EmitterSender& sender, const Receiver& receiver,
                                const RowBlock::Draft& draft, const Recorded& recorded,
                                std::span<const MovedObject> moved) const {
    const int taken = EmitterRowBuilder::samplesTaken(sender, draft);
    for (int first = 16; first < taken; first += 16) {
        SampleGroup group;
        sender.sampleGroup(receiver, first, group);
        const auto blocked = std::uint32_t((recorded.byMoved | recorded.byOthers) >> first);
        if ((lanesTowards(group, moved) & ~blocked) != 0) return true;
    }
    return false;
}

/// \return whether there is anything to be done
bool ChangeProbe::probeStored(const EmitterSender& sender, const Receiver& receiver, std::size_t r,
                              std::span<const MovedObject> moved, float& rays) {
    const RowBlock::Draft& draft = drafts_[r];
    if (!(draft.formFactor > 0)) return false;
    const Recorded recorded = recordedIn(draft, moved);
    const bool crossed = (draft.blockerCount == 0 || draft.visible != 0) &&
                         mayStandBefore(moved, receiver, sender.box());
    if (!crossed && recorded.byMoved == 0) return false;
    SampleGroup group;
    sender.sampleGroup(receiver, 0, group);
    const std::uint32_t uncovered = group.rays.used & std::uint32_t(recorded.byMoved);
    const std::uint32_t covered =
        lanesTowards(group, moved) & ~std::uint32_t(recorded.byMoved | recorded.byOthers);
    if (recorded.byMoved == 0 && covered == 0 &&
        !coversFurther(sender, receiver, draft, recorded, moved))
        return false;
    const float total = weightOf(group, group.rays.used);
    Probe& probe = probes_[r];
    const float visible = visibilityOf(draft);
    probe = {draft.formFactor * visible, draft.formFactor, visible, 0, 0};
    rays = float(std::popcount(covered) + std::popcount(uncovered));
    if (total > 0 && covered != 0) {
        probe.covered = weightOf(group, covered) / total;
        add(alone_, group, covered, r, stored_.covered, moved);
    }
    if (total > 0 && uncovered != 0) {
        probe.uncovered = weightOf(group, uncovered) / total;
        add(alone_, group, uncovered, r, stored_.uncovered, moved);
    }
    if (rays > 0) rays += kFurther;
    return true;
}

bool ChangeProbe::probeAnew(const EmitterSender& sender, const ReceiverBlock& receivers,
                            std::size_t r, float& rays) {
    const RowBlock::Draft& draft = drafts_[r];
    const Receiver& receiver = receivers.receivers[r];
    const bool wanted = (receivers.wanted >> r & 1) && !isPadding(receiver);
    const float before = draft.formFactor > 0 ? visibilityOf(draft) : 0.0f;
    probes_[r] = {draft.formFactor * before, wanted ? sender.formFactor(receiver) : 0.0f, before,
                  before, 1 - before};
    if (!(probes_[r].now > 0)) return draft.formFactor > 0;
    rays = float(sender.baseSamples()) + kFurther;
    Answers& answers = draft.formFactor > 0 ? anew_ : fresh_;
    const auto isKnown = [&](const Asked& asked) { return (asked.all & groupOf(r)) != 0; };
    if ((before == 0 || isKnown(answers.covered)) && (before == 1 || isKnown(answers.uncovered)))
        return true;
    SampleGroup group;
    sender.sampleGroup(receiver, 0, group);
    if (group.rays.used == 0) return true; // light comes along the surface
    std::uint64_t wasBlocked = draft.formFactor > 0 ? 0 : ~std::uint64_t(0);
    for (int b = 0; draft.formFactor > 0 && b < draft.blockerCount; ++b)
        wasBlocked |= draft.blockers[std::size_t(b)].samples;
    Asked& asked =
        wasBlocked >> oneOf(group.rays.used, r) & 1 ? answers.uncovered : answers.covered;
    if (!isKnown(asked)) add(whole_, group, group.rays.used, r, asked, {});
    return true;
}

/// Asks of a receiver by one of some samples (bits); if there are none, nothing is seen.
void ChangeProbe::add(Packet& packet, const SampleGroup& group, std::uint32_t samples,
                      std::size_t receiver, Asked& asked, std::span<const MovedObject> moved) {
    const std::uint64_t bit = std::uint64_t(1) << receiver;
    asked.all |= bit;
    if (samples == 0) {
        asked.blocked |= bit;
        return;
    }
    if (packet.count == ShadowRays::kMost) trace(packet, moved);
    const int sample = oneOf(samples, receiver);
    const glm::vec3 origin(group.rays.originX[sample], group.rays.originY[sample],
                           group.rays.originZ[sample]);
    const glm::vec3 along(group.rays.directionX[sample], group.rays.directionY[sample],
                          group.rays.directionZ[sample]);
    const auto at = std::size_t(packet.count);
    packet.answers[at] = &asked;
    packet.receivers[at] = receiver;
    packet.rays.set(packet.count++, origin, origin + along);
}

/// \param moved the objects to trace against; none: the whole scene
void ChangeProbe::trace(Packet& packet, std::span<const MovedObject> moved) {
    const std::uint32_t all = packet.rays.used;
    std::uint32_t blocked = 0;
    const auto traced = [&](std::uint32_t lanes) {
        for (; lanes != 0; lanes &= lanes - 1)
            if (const int i = std::countr_zero(lanes); packet.rays.blocker[i] != ObjectId::kNone)
                blocked |= 1u << i;
    };
    if (&packet == &whole_ && all != 0) {
        rays_.occluded(packet.rays);
        rayCount_.full += std::uint64_t(std::popcount(all));
        traced(all);
    }
    for (const MovedObject& m : moved) {
        if (!m.present) continue;
        const std::uint32_t some = lanesThatMeet(packet.rays, all & ~blocked, m.box);
        if (some == 0) continue;
        packet.rays.used = some;
        rays_.occludedBy({m.object}, packet.rays);
        rayCount_.single += std::uint64_t(std::popcount(some));
        traced(some);
    }
    for (const std::size_t i : bitsOf(blocked)) {
        packet.answers[i]->blocked |= std::uint64_t(1) << packet.receivers[i];
    }
    packet.rays.used = 0;
    packet.count = 0;
}

} // namespace penumbra
