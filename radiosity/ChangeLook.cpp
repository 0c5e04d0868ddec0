#include "radiosity/ChangeLook.h"

#include "radiosity/Shaft.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace penumbra {

namespace {

/// What 16 samples may have missed: this share of the block changes whatever they say.
constexpr float kLeastShare = 0.01f;

/// Who hides a sample; ObjectId::kNone if it is visible.
std::uint32_t blockerOf(const RowBlock::Draft& draft, int sample) {
    for (int b = 0; b < draft.blockerCount; ++b)
        if (draft.blockers[std::size_t(b)].samples >> sample & 1)
            return draft.blockers[std::size_t(b)].object;
    return ObjectId::kNone;
}

bool moves(std::span<const MovedObject> moved, std::uint32_t object) {
    return std::any_of(moved.begin(), moved.end(),
                       [&](const MovedObject& m) { return m.object == object; });
}

glm::vec3 originOf(const ShadowRays& rays, int i) {
    return {rays.originX[i], rays.originY[i], rays.originZ[i]};
}
glm::vec3 directionOf(const ShadowRays& rays, int i) {
    return {rays.directionX[i], rays.directionY[i], rays.directionZ[i]};
}

} // namespace

ExpectedFactor ChangeLook::at(const EmitterSender& sender, const ReceiverBlock& receivers,
                              std::uint64_t anew, std::span<const MovedObject> moved,
                              const RowBlock& block) {
    block.decode(std::span(drafts_).first(receivers.receivers.size()));
    whole_.used = alone_.used = hidden_ = traced_ = released_ = 0;
    count_ = 0;
    // Every fourth receiver, in each row of a square block another one; samples all over the
    // sender.
    for (int lane = 0; lane < ShadowRays::kMost; ++lane) {
        const auto r = std::size_t(4 * lane + (lane / 2) % 4);
        probes_[lane] = {};
        if (r >= receivers.receivers.size() || isPadding(receivers.receivers[r])) continue;
        ++count_;
        probe(lane, sender, receivers, r, (7 * lane + 3) % 16, anew >> r & 1, moved);
    }
    trace(moved);
    return summary();
}

void ChangeLook::probe(int lane, const EmitterSender& sender, const ReceiverBlock& receivers,
                       std::size_t r, int sample, bool anew, std::span<const MovedObject> moved) {
    const RowBlock::Draft& draft = drafts_[r];
    const Receiver& receiver = receivers.receivers[r];
    Probe& probe = probes_[lane];
    const std::uint32_t bit = 1u << lane;
    ShadowRays* rays = nullptr;
    if (anew) {
        const bool wanted = receivers.wanted >> r & 1;
        const float visibility = draft.visible != 0 ? draft.visibility : 0.0f;
        probe = {draft.formFactor * (draft.blockerCount == 0 ? 1.0f : visibility),
                 wanted ? sender.formFactor(receiver) : 0.0f, true};
        rays = &whole_;
    } else if (draft.formFactor > 0) {
        const std::uint32_t blocker = blockerOf(draft, sample);
        const bool visible = blocker == ObjectId::kNone;
        if (!visible && !moves(moved, blocker)) return; // stays hidden
        if (!visible) released_ |= bit;
        probe = {visible ? draft.formFactor : 0.0f, draft.formFactor, false};
        rays = &alone_;
    }
    if (!(probe.unoccluded > 0)) return;
    SampleGroup group;
    sender.sampleGroup(receiver, 0, group);
    if (!(group.rays.used >> sample & 1)) { // of a sender that is turned away in part
        hidden_ |= probe.before > 0 ? 0 : bit;
        return;
    }
    const glm::vec3 origin = originOf(group.rays, sample);
    rays->set(lane, origin, origin + directionOf(group.rays, sample));
}

void ChangeLook::trace(std::span<const MovedObject> moved) {
    const auto note = [&](const ShadowRays& rays) {
        for (std::uint32_t left = rays.used; left != 0; left &= left - 1) {
            const int i = std::countr_zero(left);
            if (rays.blocker[i] != ObjectId::kNone) hidden_ |= 1u << i;
        }
    };
    traced_ = released_;
    if (whole_.used != 0) {
        rays_.occluded(whole_);
        traced_ |= whole_.used;
        rayCount_.full += std::uint64_t(std::popcount(whole_.used));
        note(whole_);
    }
    for (const MovedObject& m : moved) {
        if (!m.present) continue;
        ShadowRays some = alone_;
        for (std::uint32_t left = alone_.used & ~hidden_; left != 0; left &= left - 1) {
            const int i = std::countr_zero(left);
            const glm::vec3 origin = originOf(alone_, i), along = directionOf(alone_, i);
            if (!sweepMeets({origin, origin}, along, along, 1.0f, m.box)) some.used &= ~(1u << i);
        }
        some.used &= ~hidden_;
        if (some.used == 0) continue;
        rays_.occludedBy({m.object}, some);
        traced_ |= some.used;
        rayCount_.single += std::uint64_t(std::popcount(some.used));
        note(some);
    }
}

ExpectedFactor ChangeLook::summary() const {
    constexpr float kPerProbe = 64; // rays: four receivers, 16 samples
    float change = 0, unoccluded = 0;
    int changed = 0, open = 0;
    const float rays = kPerProbe * float(std::popcount(traced_));
    for (int lane = 0; lane < ShadowRays::kMost; ++lane) {
        const Probe& probe = probes_[lane];
        const float now = hidden_ >> lane & 1 ? 0.0f : probe.unoccluded;
        const float difference = std::abs(now - probe.before);
        change += difference;
        changed += difference > 0;
        unoccluded += std::max(probe.unoccluded, probe.before);
        open += probe.unoccluded > 0 || probe.before > 0;
    }
    if (changed > 0)
        return {change / float(changed), std::max(kLeastShare, float(changed) / float(count_)),
                rays};
    return {open > 0 ? unoccluded / float(open) : 0.0f, kLeastShare, rays};
}

} // namespace penumbra
