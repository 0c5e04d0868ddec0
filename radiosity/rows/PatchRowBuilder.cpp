#include "radiosity/rows/PatchRowBuilder.h"

#include "base/PairHash.h"
#include "radiosity/rays/Shaft.h"
#include "radiosity/rows/FormFactor.h"
#include "radiosity/rows/SenderSamples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = ObjectId::kNone;

bool segmentMeets(glm::vec3 from, glm::vec3 to, const Bounds& box) {
    const Bounds start{from, from};
    return sweepMeets(start, to - from, to - from, 1.0f, box);
}

/// Form factor from a receiver to a small piece of a sender, per area [1/m^2].
float kernel(const Receiver& receiver, glm::vec3 at, glm::vec3 normal) {
    const glm::vec3 d = at - receiver.position;
    const float d2 = glm::dot(d, d);
    return pointKernel(facing(glm::dot(receiver.normal, d), -glm::dot(normal, d), d2), d2);
}

/// Shares of some parts as RowBlock has them: of all but the last one.
void putShares(std::span<const float> parts, std::uint8_t* shares) {
    float total = 0, upTo = 0;
    for (const float part : parts) total += part;
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) {
        upTo += parts[k];
        shares[k] = std::uint8_t(std::lround(255 * std::min(1.0f, upTo / total)));
    }
}

/// The form factor of an entry: 0 if it is left out. \param hash of the pair
float drawn(float formFactor, float least, std::uint32_t hash) {
    if (formFactor >= least) return formFactor;
    if (formFactor < kNoFactor) return 0;
    constexpr std::uint32_t kDraw = 0x5bd1e995u; // samples are chosen by the hash itself
    return 0x1p-32f * float(pairHash(hash, kDraw)) * least < formFactor ? least : 0;
}

std::uint32_t sampleCount(const PatchSender& sender, float formFactor, std::uint32_t all) {
    const auto count = std::uint32_t(samplesFor(formFactor, sender.allSamples));
    return count == kPatchSamples ? all : count;
}

RowBlock::Sharing sharingOf(const PatchSender& sender) {
    if (!sender.patch) return RowBlock::Sharing::quarters;
    return sender.cells ? RowBlock::Sharing::cells : RowBlock::Sharing::even;
}

/// Squared distance of the farthest corner of a planar patch from its middle [m^2].
float squaredRadius(const PatchSender& sender) {
    float radius2 = 0;
    for (glm::vec3 corner : sender.outline) {
        const glm::vec3 d = corner - sender.patch->centre;
        radius2 = std::max(radius2, glm::dot(d, d));
    }
    return radius2;
}

/// Unoccluded form factor of a planar patch; 0 behind it.
float patchFormFactor(const PatchSender& sender, float radius2, const Receiver& receiver) {
    const Patch& patch = *sender.patch;
    const glm::vec3 away = receiver.position - patch.centre;
    if (glm::dot(patch.normal, away) <= 0) return 0;
    // From afar the point kernel is as good as the closed form: it errs by (radius / distance)^2.
    const float distance2 = glm::dot(away, away);
    const float facing = -glm::dot(receiver.normal, away);
    if (!(distance2 > 100 * radius2 && facing > std::sqrt(radius2)))
        return polygonFormFactor(receiver.position, receiver.normal, sender.outline);
    return facing * glm::dot(patch.normal, away) * patch.area /
           (std::numbers::pi_v<float> * distance2 * distance2);
}

/// Where a sample stands among the cells of its sender: those of a quarter come one after the
/// other.
struct CellOfSample {
    CellOfSample(const PatchSender& sender, std::uint32_t sample) : within(sample) {
        const auto count = std::uint32_t(sender.isOfParts() ? sender.parts.size() : kPatchSamples);
        const auto begin = [&](std::uint32_t q) { return q * count / 4; };
        while (quarter < 3 && sample >= begin(quarter + 1)) ++quarter;
        within -= begin(quarter);
    }
    std::size_t index() const { return 4 * quarter + within; }
    std::uint32_t quarter = 0, within;
};

} // namespace

/// Works out what does not depend on the receiver.
void PatchRowBuilder::load(const PatchSender& sender) {
    if (sender.isOfParts())
        parts_.load(sender.parts,
                    sender.patch ? PartTable::Kernel::disk : PartTable::Kernel::point);
    else
        radius2_ = squaredRadius(sender);
}

/// \return the unoccluded form factor of entry r
float PatchRowBuilder::open(const PatchSender& sender, const Receiver& receiver, std::size_t r) {
    if (!sender.isOfParts()) return patchFormFactor(sender, radius2_, receiver);
    kernels_[r] = parts_.kernels(receiver);
    return kernels_[r].total;
}

/// Appends the samples of entry r, all as yet visible.
void PatchRowBuilder::listSamples(const PatchSender& sender, const ReceiverBlock& receivers,
                                  std::size_t r) {
    const Receiver& receiver = receivers.receivers[r];
    const float factor = drafts_[r].formFactor;
    const std::uint32_t hash = pairHash(sender.key, receivers.keys[r]);
    const std::size_t begin = samples_.size();
    float total = 0;
    const auto add = [&](std::uint32_t sample, float weight) {
        if (!(weight > 0)) return;
        total += weight;
        samples_.push_back({std::uint8_t(r), std::uint8_t(sample), weight, kNone});
    };
    if (!sender.isOfParts()) {
        const std::uint32_t count = sampleCount(sender, factor, kPatchSamples);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t sample = count == kPatchSamples ? k
                                         : count == 4           ? 4 * k + (hash >> 2 * k & 3)
                                                                : hash & 15;
            add(sample, kernel(receiver, sender.samples[sample], sender.patch->normal));
        }
    } else {
        const PartKernels& kernels = kernels_[r];
        const std::uint32_t count = sampleCount(sender, factor, kernels.count);
        for (std::uint32_t k = 0; k < count; ++k) {
            // Any of the group's parts that faces the receiver represents all of them.
            const std::uint32_t first = kernels.begin(k, count), last = kernels.begin(k + 1, count);
            std::uint32_t sample = first + (hash >> 2 * k) % (last - first);
            for (std::uint32_t i = first; i < last && !(kernels.part[sample] > 0); ++i)
                sample = sample + 1 < last ? sample + 1 : first;
            add(sample, kernels.sum(first, last));
        }
    }
    for (std::size_t k = begin; k < samples_.size(); ++k) samples_[k].weight /= total;
}

/// The same, with the blockers that are on record.
void PatchRowBuilder::recallSamples(const PatchSender& sender, const ReceiverBlock& receivers,
                                    std::size_t r) {
    const std::size_t begin = samples_.size();
    if (sender.isOfParts()) kernels_[r] = parts_.kernels(receivers.receivers[r]);
    listSamples(sender, receivers, r);
    for (std::size_t k = begin; k < samples_.size(); ++k)
        samples_[k].blocker = drafts_[r].blockerOf(samples_[k].index);
}

/// Lists the samples of entry r anew. \return whether there are any; if not, there is no entry
bool PatchRowBuilder::list(const PatchSender& sender, const ReceiverBlock& receivers,
                           std::size_t r) {
    if (!(receivers.wanted >> r & 1)) return false;
    const float factor = drawn(open(sender, receivers.receivers[r], r), sender.least,
                               pairHash(sender.key, receivers.keys[r]));
    if (!(factor > 0)) return false;
    drafts_[r].formFactor = SmallFloat(factor);
    const std::size_t begin = samples_.size();
    listSamples(sender, receivers, r);
    return samples_.size() > begin;
}

/// Traces the samples that `choose` accepts, through the whole scene or against one object alone.
template <class Choose>
void PatchRowBuilder::trace(const PatchSender& sender, const ReceiverBlock& receivers,
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
        for (std::size_t i = 0; i < count; ++i) samples_[lane[i]].blocker = rays.blocker[i];
        rays.used = 0;
        count = 0;
    };
    for (std::size_t k = 0; k < samples_.size(); ++k) {
        const Sample& ray = samples_[k];
        if (!choose(ray)) continue;
        lane[count] = k;
        rays.set(int(count++), receivers.receivers[ray.receiver].position,
                 sender.samples[ray.index]);
        if (count == 16) flush();
    }
    flush();
}

template <class Visit>
void PatchRowBuilder::forEachEntry(Visit visit) const {
    for (std::size_t first = 0, last = 0; first < samples_.size(); first = last) {
        const std::uint8_t r = samples_[first].receiver;
        while (last < samples_.size() && samples_[last].receiver == r) ++last;
        visit(EntrySamples{r, first, last});
    }
}

/// Writes what the listed samples of one entry say into it.
void PatchRowBuilder::collect(const PatchSender& sender, const EntrySamples& entry) {
    RowBlock::Draft& draft = drafts_[entry.receiver];
    draft.begin(draft.formFactor);
    draft.visibility = 0;
    for (std::size_t k = entry.first; k < entry.last; ++k) {
        const Sample& sample = samples_[k];
        if (sample.blocker == kNone) {
            draft.visible |= std::uint64_t(1) << sample.index;
            draft.visibility += sample.weight;
        } else {
            draft.block(sample.blocker, sample.index);
        }
    }
    if (draft.visible != 0) draft.visibility = SmallFloat(draft.visibility);
    draft.sharing = sharingOf(sender);
    draft.allSamples = sender.allSamples && RowBlock::hasShares(draft.sharing);
    if (draft.visible != 0 && RowBlock::hasShares(draft.sharing)) share(sender, entry);
}

/// Notes how much is visible of each cell: a sample stands for the cell that it lies in, of four
/// for that one's quarter, and a single one for all of the sender.
void PatchRowBuilder::share(const PatchSender& sender, const EntrySamples& entry) {
    RowBlock::Draft& draft = drafts_[entry.receiver];
    const int count = samplesFor(draft.formFactor, sender.allSamples);
    std::array<float, kPatchSamples> cells{}, quarters{};
    for (std::size_t k = entry.first; k < entry.last; ++k) {
        const Sample& sample = samples_[k];
        if (sample.blocker != kNone) continue;
        const CellOfSample cell(sender, sample.index);
        if (count == 1) draft.shares[0] = std::uint8_t(cell.index());
        if (count == 4) draft.shares[0] |= std::uint8_t(cell.within << 2 * cell.quarter);
        cells[cell.index()] = sample.weight;
        quarters[cell.quarter] += sample.weight;
    }
    if (count == kPatchSamples) return putShares(cells, draft.shares.data());
    if (count == 1 && sender.patch) return;
    if (count == 1) { // which of the quarters it was tells nothing of how much each is
        const PartKernels& kernels = kernels_[entry.receiver];
        for (std::uint32_t q = 0; q < 4; ++q)
            quarters[q] = kernels.sum(kernels.begin(q, 4), kernels.begin(q + 1, 4));
    }
    putShares(std::span(quarters).first(4), draft.shares.data() + 1);
}

void PatchRowBuilder::build(const PatchSender& sender, const ReceiverBlock& receivers,
                            RowBlock& block) {
    samples_.clear();
    load(sender);
    std::uint64_t listed = 0;
    for (std::size_t r = 0; r < receivers.receivers.size(); ++r)
        listed |= std::uint64_t(list(sender, receivers, r)) << r;
    trace(
        sender, receivers, [](const Sample&) { return true; }, nullptr);
    forEachEntry([&](const EntrySamples& entry) { collect(sender, entry); });
    block.assign(drafts(receivers), listed);
}

/// Lists the samples of all entries that may not be what they were.
/// \return bits: entries that there were and are no more
std::uint64_t PatchRowBuilder::listDirty(const PatchSender& sender, const ReceiverBlock& receivers,
                                         std::uint64_t anew, std::span<const MovedObject> moved) {
    samples_.clear();
    std::uint64_t emptied = 0;
    for (std::size_t r = 0; r < receivers.receivers.size(); ++r) {
        const bool before = drafts_[r].formFactor > 0;
        if (anew >> r & 1) {
            if (list(sender, receivers, r)) continue;
            drafts_[r].begin(0);
            emptied |= std::uint64_t(before) << r;
        } else if (before && mayDiffer(drafts_[r], moved, receivers.receivers[r], *sender.box)) {
            recallSamples(sender, receivers, r);
        }
    }
    return emptied;
}

void PatchRowBuilder::retrace(const PatchSender& sender, const ReceiverBlock& receivers,
                              std::uint64_t anew, std::span<const MovedObject> moved) {
    const auto isNew = [&](const Sample& sample) { return anew >> sample.receiver & 1; };
    // First what was visible, against what moved; what that blocks is not traced again.
    std::vector<std::uint8_t> whole(samples_.size());
    for (std::size_t k = 0; k < whole.size(); ++k)
        whole[k] = isNew(samples_[k]) || isAmong(moved, samples_[k].blocker);
    for (const MovedObject& m : moved) {
        if (!m.present) continue;
        trace(
            sender, receivers,
            [&](const Sample& sample) {
                return sample.blocker == kNone && !isNew(sample) &&
                       segmentMeets(receivers.receivers[sample.receiver].position,
                                    sender.samples[sample.index], m.box);
            },
            &m);
    }
    const Sample* const begin = samples_.data();
    trace(
        sender, receivers,
        [&](const Sample& sample) { return whole[std::size_t(&sample - begin)]; }, nullptr);
}

bool PatchRowBuilder::differs(const EntrySamples& entry) const {
    const RowBlock::Draft& draft = drafts_[entry.receiver];
    return std::any_of(samples_.begin() + std::ptrdiff_t(entry.first),
                       samples_.begin() + std::ptrdiff_t(entry.last), [&](const Sample& sample) {
                           return sample.blocker != draft.blockerOf(sample.index);
                       });
}

int PatchRowBuilder::update(const PatchSender& sender, const ReceiverBlock& receivers,
                            std::uint64_t anew, std::span<const MovedObject> moved,
                            RowBlock& block) {
    block.decode(drafts(receivers));
    load(sender);
    int changed = std::popcount(listDirty(sender, receivers, anew, moved));
    retrace(sender, receivers, anew, moved);
    forEachEntry([&](const EntrySamples& entry) {
        if (!(anew >> entry.receiver & 1) && !differs(entry)) return;
        collect(sender, entry);
        ++changed;
    });
    if (changed > 0) block.assign(drafts(receivers));
    return changed;
}

} // namespace penumbra
