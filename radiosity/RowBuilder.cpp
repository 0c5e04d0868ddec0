#include "radiosity/RowBuilder.h"

#include "radiosity/FormFactor.h"
#include "radiosity/SenderSamples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {

void RowBuilder::emitterVisibility(const EmitterSender& sender, const Receiver& receiver,
                                   RowBlock::Draft& draft) {
    float total = 0, seen = 0;
    draft.visible = 0;
    draft.blockerCount = 0;
    // A sender that fills much of the sky is sampled in full at once.
    const int base = draft.formFactor > 0.15f ? sender.allSamples() : sender.baseSamples();
    int count = base;
    SampleGroup group;
    for (int first = 0; first < count; first += 16) {
        sender.sampleGroup(receiver, first, group);
        if (group.rays.used == 0) continue;
        rays_.occluded(group.rays);
        rayCount_ += std::uint64_t(std::popcount(group.rays.used));
        for (int i = 0; i < 16; ++i) {
            if (!(group.rays.used >> i & 1)) continue;
            total += group.weight[i];
            if (group.rays.blocker[i] == ObjectId::kNone) {
                seen += group.weight[i];
                draft.visible |= std::uint64_t(1) << (first + i);
            } else {
                draft.block(group.rays.blocker[i], first + i);
            }
        }
        // More where the first ones disagree.
        if (first + 16 == base && draft.visible != 0 && draft.blockerCount != 0)
            count = sender.allSamples();
    }
    draft.visibility = draft.blockerCount == 0 ? 1.0f : total > 0 ? seen / total : 0.0f;
}

void RowBuilder::emitterBlock(const EmitterSender& sender, std::span<const Receiver> receivers,
                              RowBlock& block) {
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        RowBlock::Draft& draft = drafts_[i];
        draft.begin(sender.formFactor(receivers[i]));
        if (draft.formFactor > 0) emitterVisibility(sender, receivers[i], draft);
    }
    block.assign(std::span(drafts_).first(receivers.size()));
}

void RowBuilder::tracePatchRays(const glm::vec3* samples, std::span<const Receiver> receivers) {
    for (std::size_t first = 0; first < patchRays_.size(); first += 16) {
        const std::size_t count = std::min<std::size_t>(16, patchRays_.size() - first);
        ShadowRays rays;
        for (std::size_t i = 0; i < count; ++i) {
            const PatchRay& ray = patchRays_[first + i];
            rays.set(int(i), receivers[ray.receiver].position, samples[ray.sample]);
        }
        rays_.occluded(rays);
        for (std::size_t i = 0; i < count; ++i) {
            const PatchRay& ray = patchRays_[first + i];
            RowBlock::Draft& draft = drafts_[ray.receiver];
            if (rays.blocker[i] == ObjectId::kNone) {
                draft.visible |= std::uint64_t(1) << ray.sample;
                draft.visibility += ray.weight;
            } else {
                draft.block(rays.blocker[i], ray.sample);
            }
        }
    }
    rayCount_ += patchRays_.size();
}

void RowBuilder::patchBlock(const PatchSet& set, std::uint32_t patch, const glm::vec3* samples,
                            std::span<const Receiver> receivers, std::uint64_t wanted,
                            std::uint32_t firstReceiver, RowBlock& block) {
    const Patch& sender = set.patches[patch];
    const auto outline = std::span(set.corners).subspan(sender.firstCorner, sender.cornerCount);
    float radius2 = 0;
    for (glm::vec3 corner : outline)
        radius2 = std::max(radius2, glm::dot(corner - sender.centre, corner - sender.centre));
    patchRays_.clear();
    for (std::size_t r = 0; r < receivers.size(); ++r) {
        const Receiver& receiver = receivers[r];
        RowBlock::Draft& draft = drafts_[r];
        draft.begin(0);
        if (!(wanted >> r & 1)) continue;
        const glm::vec3 away = receiver.position - sender.centre;
        if (glm::dot(sender.normal, away) <= 0) continue;
        // From afar the point kernel is as good as the closed form: it errs by (radius /
        // distance)^2.
        const float distance2 = glm::dot(away, away);
        const float facing = -glm::dot(receiver.normal, away);
        const bool small = distance2 > 100 * radius2 && facing > std::sqrt(radius2);
        const float factor = small ? facing * glm::dot(sender.normal, away) * sender.area /
                                         (std::numbers::pi_v<float> * distance2 * distance2)
                                   : polygonFormFactor(receiver.position, receiver.normal, outline);
        if (!(factor > 1e-9f)) continue;
        draft.begin(factor);
        draft.visibility = 0;

        const std::uint32_t hash = pairHash(patch, firstReceiver + std::uint32_t(r));
        const std::uint32_t count = factor > 0.01f ? 16 : factor > 0.0005f ? 4 : 1;
        float total = 0;
        const std::size_t begin = patchRays_.size();
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t sample = count == 16  ? k
                                         : count == 4 ? 4 * k + (hash >> 2 * k & 3)
                                                      : hash & 15;
            const glm::vec3 d = samples[sample] - receiver.position;
            const float d2 = glm::dot(d, d);
            const float weight = std::max(0.0f, glm::dot(receiver.normal, d)) *
                                 std::max(0.0f, -glm::dot(sender.normal, d)) / (d2 * d2);
            if (!(weight > 0)) continue;
            total += weight;
            patchRays_.push_back({std::uint8_t(r), std::uint8_t(sample), weight});
        }
        if (patchRays_.size() == begin) draft.formFactor = 0;
        for (std::size_t k = begin; k < patchRays_.size(); ++k) patchRays_[k].weight /= total;
    }
    tracePatchRays(samples, receivers);
    block.assign(std::span(drafts_).first(receivers.size()));
}

} // namespace penumbra
