// Fills rows of direct light: form factors of emitters in closed form, visibility by rays.
#pragma once

#include "radiosity/rays/RayCount.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/MovedObject.h"
#include "radiosity/rows/ReceiverBlock.h"
#include "radiosity/rows/Row.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// Updates one block of an emitter's row at a time; one builder a thread, for it owns scratch
/// space. RowBuilder says what holds of an updated block.
class EmitterRowBuilder {
public:
    explicit EmitterRowBuilder(const RayScene& rays) : rays_(rays), drafts_(RowBlock::kSize) {}

    /// Brings some entries of a block up to date. What is not wanted has none then.
    /// \param anew bits: entries to be evaluated anew
    /// \return the number of entries that are not what they were
    int update(const EmitterSender& sender, const ReceiverBlock& receivers, std::uint64_t anew,
               std::span<const MovedObject> moved, RowBlock& block);

    /// How many samples of an entry are on record.
    static int samplesTaken(const EmitterSender& sender, const RowBlock::Draft& draft);

    /// Rays since the last call.
    RayCount takeRayCount() { return std::exchange(rayCount_, {}); }

private:
    struct Pair;
    void evaluate(const EmitterSender& sender, const Receiver& receiver, RowBlock::Draft& draft);
    bool retest(const EmitterSender& sender, const Receiver& receiver,
                std::span<const MovedObject> moved, RowBlock::Draft& draft);
    bool retestGroup(std::span<const MovedObject> moved, int first, ShadowRays& rays, Pair& pair);
    void trace(SampleGroup& group, int first, Pair& pair);

    const RayScene& rays_;
    std::vector<RowBlock::Draft> drafts_;
    RayCount rayCount_;
};

} // namespace penumbra
