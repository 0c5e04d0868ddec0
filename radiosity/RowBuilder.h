// Fills rows of the shadow-form-factor-list: form factors in closed form, visibility by rays.
#pragma once

#include "radiosity/EmitterSender.h"
#include "radiosity/PatchSet.h"
#include "radiosity/RayScene.h"
#include "radiosity/Row.h"

#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Builds one block of one row at a time; one builder a thread, for it owns scratch space.
class RowBuilder {
public:
    explicit RowBuilder(const RayScene& rays) : rays_(rays), drafts_(RowBlock::kSize) {}

    /// Direct light: an emitter onto up to 64 receivers.
    void emitterBlock(const EmitterSender& sender, std::span<const Receiver> receivers,
                      RowBlock& block);

    /// Indirect light: a patch onto up to 64 receivers. The number of samples follows the form
    /// factor (1, 4 or 16); which ones is a fixed function of the pair. \param samples
    /// kPatchSamples points on the patch \param wanted         bits: receivers that need an entry
    /// \param firstReceiver  index of receivers[0], part of the pair's name
    void patchBlock(const PatchSet& set, std::uint32_t patch, const glm::vec3* samples,
                    std::span<const Receiver> receivers, std::uint64_t wanted,
                    std::uint32_t firstReceiver, RowBlock& block);

    /// Weighted visibility of an emitter from one receiver, written into `draft`.
    void emitterVisibility(const EmitterSender& sender, const Receiver& receiver,
                           RowBlock::Draft& draft);

    std::uint64_t rayCount() const { return rayCount_; }

private:
    struct PatchRay {
        std::uint8_t receiver, sample;
        float weight;
    };
    void tracePatchRays(const glm::vec3* samples, std::span<const Receiver> receivers);

    const RayScene& rays_;
    std::vector<RowBlock::Draft> drafts_;
    std::vector<PatchRay> patchRays_;
    std::uint64_t rayCount_ = 0;
};

} // namespace penumbra
