#include "radiosity/rows/RowBuilder.h"

#include "base/Bits.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/rows/FormFactor.h"
#include "radiosity/rows/SenderSamples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = ObjectId::kNone;

bool blockedByAny(const RowBlock::Draft& draft, std::span<const MovedObject> moved) {
    return std::any_of(draft.blockers.begin(), draft.blockers.begin() + draft.blockerCount,
                       [&](const Blocker& b) { return isAmong(moved, b.object); });
}

/// Who blocks a sample; kNone if it is visible.
std::uint32_t blockerOf(const RowBlock::Draft& draft, int sample) {
    for (int b = 0; b < draft.blockerCount; ++b)
        if (draft.blockers[std::size_t(b)].samples >> sample & 1)
            return draft.blockers[std::size_t(b)].object;
    return kNone;
}

bool segmentMeets(glm::vec3 from, glm::vec3 to, const Bounds& box) {
    const Bounds start{from, from};
    return sweepMeets(start, to - from, to - from, 1.0f, box);
}

} // namespace

bool isAmong(std::span<const MovedObject> moved, std::uint32_t object) {
    return std::any_of(moved.begin(), moved.end(),
                       [&](const MovedObject& m) { return m.object == object; });
}

bool mayStandBefore(std::span<const MovedObject> moved, const Receiver& receiver,
                    const Bounds& box) {
    const Bounds point{receiver.position, receiver.position};
    return std::any_of(moved.begin(), moved.end(), [&](const MovedObject& m) {
        return m.present && shaftMeets(point, box, m.box);
    });
}

namespace {

/// The samples of an emitter and a receiver, gone through 16 at a time.
struct EmitterPair {
    float weight[RowBlock::kSize];
    std::uint32_t blocker[RowBlock::kSize];
    std::uint64_t used = 0;

    /// \return bit 0: some of the first `count` samples are visible; bit 1: some are blocked
    int states(int count) const {
        int found = 0;
        for (int i = 0; i < count; ++i)
            if (used >> i & 1) found |= blocker[i] == kNone ? 1 : 2;
        return found;
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
    void take(const RayScene& rays, const SampleGroup& group, int first, RayCount& count) {
        std::copy_n(group.weight, 16, weight + first);
        used |= std::uint64_t(group.rays.used) << first;
        if (group.rays.used == 0) return;
        SampleGroup traced = group;
        rays.occluded(traced.rays);
        count.full += std::uint64_t(std::popcount(group.rays.used));
        std::copy_n(traced.rays.blocker, 16, blocker + first);
    }
};

/// Samples that are always taken: all of a sender that fills much of the sky.
int firstSamples(const EmitterSender& sender, float formFactor) {
    return formFactor > 0.15f ? sender.allSamples() : sender.baseSamples();
}

} // namespace

void RowBuilder::emitterEntry(const EmitterSender& sender, const Receiver& receiver,
                              RowBlock::Draft& draft) {
    EmitterPair pair;
    SampleGroup group;
    int count = firstSamples(sender, draft.formFactor);
    for (int first = 0; first < count; first += 16) {
        sender.sampleGroup(receiver, first, group);
        pair.take(rays_, group, first, rayCount_);
        // More where the first ones disagree.
        if (first + 16 == count && pair.states(count) == 3) count = sender.allSamples();
    }
    pair.write(count, draft);
}

int RowBuilder::samplesTaken(const EmitterSender& sender, const RowBlock::Draft& draft) {
    return draft.visible != 0 && draft.blockerCount != 0 ? sender.allSamples()
                                                         : firstSamples(sender, draft.formFactor);
}

bool RowBuilder::retestEmitterEntry(const EmitterSender& sender, const Receiver& receiver,
                                    std::span<const MovedObject> moved, RowBlock::Draft& draft) {
    const bool open = draft.visible != 0 && mayStandBefore(moved, receiver, sender.box());
    if (!open && !blockedByAny(draft, moved)) return false;

    const int base = firstSamples(sender, draft.formFactor), all = sender.allSamples();
    const int taken = samplesTaken(sender, draft);
    EmitterPair pair;
    SampleGroup group;
    bool changed = false;
    for (int first = 0; first < taken; first += 16) {
        sender.sampleGroup(receiver, first, group);
        std::copy_n(group.weight, 16, pair.weight + first);
        const std::uint32_t used = group.rays.used;
        pair.used |= std::uint64_t(used) << first;
        std::uint32_t visible = 0, again = 0;
        for (int i = 0; i < 16; ++i) {
            const std::uint32_t blocker = blockerOf(draft, first + i);
            pair.blocker[first + i] = blocker;
            if (!(used >> i & 1)) continue;
            if (blocker == kNone)
                visible |= 1u << i;
            else if (isAmong(moved, blocker))
                again |= 1u << i;
        }
        const auto note = [&](std::uint32_t lanes) {
            for (const int i : bitsOf(lanes)) {
                changed |= pair.blocker[first + i] != group.rays.blocker[i];
                pair.blocker[first + i] = group.rays.blocker[i];
                if (group.rays.blocker[i] != kNone) visible &= ~(1u << i);
            }
        };
        for (const MovedObject& m : moved) {
            if (!m.present || visible == 0) continue;
            group.rays.used = lanesThatMeet(group.rays, visible, m.box);
            if (group.rays.used == 0) continue;
            rays_.occludedBy({m.object}, group.rays);
            rayCount_.single += std::uint64_t(std::popcount(group.rays.used));
            note(group.rays.used);
        }
        if (again == 0) continue;
        group.rays.used = again;
        rays_.occluded(group.rays);
        rayCount_.full += std::uint64_t(std::popcount(again));
        note(again);
    }
    if (!changed) return false;
    const bool disagree = pair.states(base) == 3;
    for (int first = taken; disagree && first < all; first += 16) {
        sender.sampleGroup(receiver, first, group);
        pair.take(rays_, group, first, rayCount_);
    }
    pair.write(disagree ? all : base, draft);
    return true;
}

int RowBuilder::updateEmitterBlock(const EmitterSender& sender, const ReceiverBlock& receivers,
                                   std::uint64_t anew, std::span<const MovedObject> moved,
                                   RowBlock& block) {
    const auto drafts = std::span(drafts_).first(receivers.receivers.size());
    block.decode(drafts);
    int changed = 0;
    for (std::size_t r = 0; r < drafts.size(); ++r) {
        RowBlock::Draft& draft = drafts[r];
        if (!(receivers.some >> r & 1)) continue;
        if (anew >> r & 1) {
            const bool before = draft.formFactor > 0, wanted = receivers.wanted >> r & 1;
            draft.begin(wanted ? sender.formFactor(receivers.receivers[r]) : 0.0f);
            if (draft.formFactor > 0) emitterEntry(sender, receivers.receivers[r], draft);
            changed += before || draft.formFactor > 0;
        } else if (draft.formFactor > 0) {
            changed += retestEmitterEntry(sender, receivers.receivers[r], moved, draft);
        }
    }
    if (changed > 0) block.assign(drafts);
    return changed;
}

namespace {

/// Form factor from a receiver to a small piece of a sender, per area [1/m^2].
float kernel(const Receiver& receiver, glm::vec3 at, glm::vec3 normal) {
    const glm::vec3 d = at - receiver.position;
    const float d2 = glm::dot(d, d);
    return facing(glm::dot(receiver.normal, d), -glm::dot(normal, d), d2) /
           (std::numbers::pi_v<float> * d2 * d2);
}

/// Unoccluded form factors of a cluster's parts, in order; each quarter of them stands for a
/// quarter of the cluster.
struct PartKernels {
    PartKernels(const PatchSender& sender, const Receiver& receiver)
        : count(std::uint32_t(sender.parts.size())) {
        for (std::uint32_t k = 0; k < count; ++k) {
            const SenderPart& piece = sender.parts[k];
            part[k] = piece.area * kernel(receiver, piece.centre, piece.normal);
            total += part[k];
        }
    }
    std::uint32_t begin(std::uint32_t group, std::uint32_t groups) const {
        return group * count / groups;
    }
    float sum(std::uint32_t first, std::uint32_t last) const {
        float sum = 0;
        for (std::uint32_t k = first; k < last; ++k) sum += part[k];
        return sum;
    }
    std::uint32_t count;
    float part[kPatchSamples];
    float total = 0;
};

RowBlock::Split splitOf(const float (&quarter)[4]) {
    const float total = quarter[0] + quarter[1] + quarter[2] + quarter[3];
    RowBlock::Split split{};
    float upTo = 0;
    for (std::size_t q = 0; q < 3; ++q) {
        upTo += quarter[q];
        split[q] = std::uint8_t(std::lround(255 * std::min(1.0f, upTo / total)));
    }
    return split;
}

std::uint32_t sampleCount(float formFactor, std::uint32_t all) {
    return formFactor > 0.01f ? all : formFactor > 0.0005f ? 4 : 1;
}

} // namespace

/// Begins an entry with its unoccluded form factor; false if there is none.
bool RowBuilder::openPatchEntry(const PatchSender& sender, const Receiver& receiver,
                                RowBlock::Draft& draft) {
    draft.begin(0);
    if (!sender.patch) {
        const PartKernels kernels(sender, receiver);
        if (!(kernels.total > 1e-9f)) return false;
        draft.begin(kernels.total);
        draft.parted = true;
        return true;
    }
    const Patch& patch = *sender.patch;
    const glm::vec3 away = receiver.position - patch.centre;
    if (glm::dot(patch.normal, away) <= 0) return false;
    float radius2 = 0;
    for (glm::vec3 corner : sender.outline)
        radius2 = std::max(radius2, glm::dot(corner - patch.centre, corner - patch.centre));
    // From afar the point kernel is as good as the closed form: it errs by (radius / distance)^2.
    const float distance2 = glm::dot(away, away);
    const float facing = -glm::dot(receiver.normal, away);
    const bool small = distance2 > 100 * radius2 && facing > std::sqrt(radius2);
    const float factor =
        small ? facing * glm::dot(patch.normal, away) * patch.area /
                    (std::numbers::pi_v<float> * distance2 * distance2)
              : polygonFormFactor(receiver.position, receiver.normal, sender.outline);
    if (!(factor > 1e-9f)) return false;
    draft.begin(factor);
    return true;
}

/// Appends the samples of entry r, all as yet visible.
void RowBuilder::listPatchRays(const PatchSender& sender, const ReceiverBlock& receivers,
                               std::size_t r) {
    const Receiver& receiver = receivers.receivers[r];
    const float factor = drafts_[r].formFactor;
    const std::uint32_t hash = pairHash(sender.key, receivers.key + std::uint32_t(r));
    const std::size_t begin = patchRays_.size();
    float total = 0;
    const auto add = [&](std::uint32_t sample, float weight) {
        if (!(weight > 0)) return;
        total += weight;
        patchRays_.push_back({std::uint8_t(r), std::uint8_t(sample), weight, kNone});
    };
    if (sender.patch) {
        const std::uint32_t count = sampleCount(factor, kPatchSamples);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t sample = count == kPatchSamples ? k
                                         : count == 4           ? 4 * k + (hash >> 2 * k & 3)
                                                                : hash & 15;
            add(sample, kernel(receiver, sender.samples[sample], sender.patch->normal));
        }
    } else {
        const PartKernels kernels(sender, receiver);
        const std::uint32_t count = sampleCount(factor, kernels.count);
        for (std::uint32_t k = 0; k < count; ++k) {
            // Any of the group's parts that faces the receiver stands for all of them.
            const std::uint32_t first = kernels.begin(k, count), last = kernels.begin(k + 1, count);
            std::uint32_t sample = first + (hash >> 2 * k) % (last - first);
            for (std::uint32_t i = first; i < last && !(kernels.part[sample] > 0); ++i)
                sample = sample + 1 < last ? sample + 1 : first;
            add(sample, kernels.sum(first, last));
        }
    }
    for (std::size_t k = begin; k < patchRays_.size(); ++k) patchRays_[k].weight /= total;
}

/// Traces the samples that `choose` accepts, through the whole scene or against one object alone.
template <class Choose>
void RowBuilder::tracePatchRays(const PatchSender& sender, const ReceiverBlock& receivers,
                                Choose choose, const MovedObject* alone) {
    std::array<std::size_t, 16> lane{};
    ShadowRays rays;
    std::size_t count = 0;
    const auto flush = [&] {
        if (count == 0) return;
        if (alone)
            rays_.occludedBy({alone->object}, rays);
        else
            rays_.occluded(rays);
        (alone ? rayCount_.single : rayCount_.full) += count;
        for (std::size_t i = 0; i < count; ++i) patchRays_[lane[i]].blocker = rays.blocker[i];
        rays.used = 0;
        count = 0;
    };
    for (std::size_t k = 0; k < patchRays_.size(); ++k) {
        const PatchRay& ray = patchRays_[k];
        if (!choose(ray)) continue;
        lane[count] = k;
        rays.set(int(count++), receivers.receivers[ray.receiver].position,
                 sender.samples[ray.sample]);
        if (count == 16) flush();
    }
    flush();
}

/// Writes what the listed samples of one entry say into it.
void RowBuilder::collectPatchRays(const PatchSender& sender, const Receiver& receiver,
                                  std::size_t first, std::size_t last) {
    RowBlock::Draft& draft = drafts_[patchRays_[first].receiver];
    draft.begin(draft.formFactor);
    draft.visibility = 0;
    for (std::size_t k = first; k < last; ++k) {
        const PatchRay& ray = patchRays_[k];
        if (ray.blocker == kNone) {
            draft.visible |= std::uint64_t(1) << ray.sample;
            draft.visibility += ray.weight;
        } else {
            draft.block(ray.blocker, ray.sample);
        }
    }
    if (sender.patch) return;
    draft.parted = true;
    if (draft.visible == 0) return;
    // Each quarter by what of it is visible.
    const PartKernels kernels(sender, receiver);
    const std::uint32_t groups = sampleCount(draft.formFactor, kernels.count);
    float quarter[4] = {};
    for (std::uint32_t k = 0; k < kernels.count; ++k) {
        std::uint32_t group = 0, of = 0;
        while (k >= kernels.begin(group + 1, groups)) ++group;
        while (k >= kernels.begin(of + 1, 4)) ++of;
        const std::uint64_t samples = (std::uint64_t(1) << kernels.begin(group + 1, groups)) -
                                      (std::uint64_t(1) << kernels.begin(group, groups));
        if (draft.visible & samples) quarter[of] += kernels.part[k];
    }
    draft.split = splitOf(quarter);
}

/// The same for all entries that have samples.
void RowBuilder::collectPatchRays(const PatchSender& sender, const ReceiverBlock& receivers) {
    for (std::size_t first = 0, last = 0; first < patchRays_.size(); first = last) {
        const std::uint8_t r = patchRays_[first].receiver;
        while (last < patchRays_.size() && patchRays_[last].receiver == r) ++last;
        collectPatchRays(sender, receivers.receivers[r], first, last);
    }
}

void RowBuilder::patchBlock(const PatchSender& sender, const ReceiverBlock& receivers,
                            RowBlock& block) {
    patchRays_.clear();
    const auto drafts = std::span(drafts_).first(receivers.receivers.size());
    for (std::size_t r = 0; r < drafts.size(); ++r) {
        drafts[r].begin(0);
        if (!(receivers.wanted >> r & 1)) continue;
        if (!openPatchEntry(sender, receivers.receivers[r], drafts[r])) continue;
        const std::size_t begin = patchRays_.size();
        listPatchRays(sender, receivers, r);
        if (patchRays_.size() == begin) drafts[r].formFactor = 0;
    }
    tracePatchRays(
        sender, receivers, [](const PatchRay&) { return true; }, nullptr);
    collectPatchRays(sender, receivers);
    block.assign(drafts);
}

int RowBuilder::updatePatchBlock(const PatchSender& sender, const ReceiverBlock& receivers,
                                 std::uint64_t anew, std::span<const MovedObject> moved,
                                 RowBlock& block) {
    const auto drafts = std::span(drafts_).first(receivers.receivers.size());
    block.decode(drafts);
    patchRays_.clear();
    int changed = 0;
    std::uint64_t emptied = 0;
    for (std::size_t r = 0; r < drafts.size(); ++r) {
        RowBlock::Draft& draft = drafts[r];
        const Receiver& receiver = receivers.receivers[r];
        const std::size_t begin = patchRays_.size();
        if (anew >> r & 1) {
            const bool before = draft.formFactor > 0;
            const bool opened =
                (receivers.wanted >> r & 1) && openPatchEntry(sender, receiver, draft);
            if (opened) listPatchRays(sender, receivers, r);
            if (patchRays_.size() == begin) {
                draft.begin(0);
                emptied |= std::uint64_t(before) << r;
            }
            continue;
        }
        if (!(draft.formFactor > 0)) continue;
        const bool open = draft.visible != 0 && mayStandBefore(moved, receiver, *sender.box);
        if (!open && !blockedByAny(draft, moved)) continue;
        listPatchRays(sender, receivers, r);
        for (std::size_t k = begin; k < patchRays_.size(); ++k)
            patchRays_[k].blocker = blockerOf(draft, patchRays_[k].sample);
    }
    const auto isNew = [&](const PatchRay& ray) { return anew >> ray.receiver & 1; };
    const auto again = [&](const PatchRay& ray) {
        return isNew(ray) || isAmong(moved, ray.blocker);
    };
    // First what was visible, against what moved; what that blocks is not traced again.
    std::vector<std::uint8_t> retraced(patchRays_.size());
    for (std::size_t k = 0; k < retraced.size(); ++k) retraced[k] = again(patchRays_[k]);
    for (const MovedObject& m : moved) {
        if (!m.present) continue;
        tracePatchRays(
            sender, receivers,
            [&](const PatchRay& ray) {
                return ray.blocker == kNone && !isNew(ray) &&
                       segmentMeets(receivers.receivers[ray.receiver].position,
                                    sender.samples[ray.sample], m.box);
            },
            &m);
    }
    const PatchRay* const begin = patchRays_.data();
    tracePatchRays(
        sender, receivers, [&](const PatchRay& ray) { return retraced[std::size_t(&ray - begin)]; },
        nullptr);

    for (std::size_t first = 0; first < patchRays_.size();) {
        std::size_t last = first;
        const std::size_t r = patchRays_[first].receiver;
        bool differs = anew >> r & 1;
        for (; last < patchRays_.size() && patchRays_[last].receiver == r; ++last)
            differs |= patchRays_[last].blocker != blockerOf(drafts[r], patchRays_[last].sample);
        if (differs) collectPatchRays(sender, receivers.receivers[r], first, last);
        changed += differs;
        first = last;
    }
    changed += std::popcount(emptied);
    if (changed > 0) block.assign(drafts);
    return changed;
}

} // namespace penumbra
