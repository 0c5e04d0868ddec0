// Fills rows of the shadow-form-factor-list: form factors in closed form, visibility by rays.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/Row.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// A piece of a cluster as it is seen from far away.
struct SenderPart {
    glm::vec3 centre{}; ///< [m, world]
    glm::vec3 normal{}; ///< mean, unit
    float area = 0;     ///< as its mean normal sees it [m^2]
};

/// A patch, or a cluster of patches, made ready to send light to receivers.
struct PatchSender {
    const Patch* patch = nullptr;       ///< null: a cluster
    std::span<const glm::vec3> outline; ///< of a patch
    std::span<const SenderPart> parts;  ///< of a cluster, as many as it has samples
    const glm::vec3* samples =
        nullptr;                 ///< points on the surface [m, world]; kPatchSamples of a patch
    const Bounds* box = nullptr; ///< around all of that [m, world]
    std::uint32_t key = 0;       ///< names the sender in every scene that has it
};

/// Up to 64 receivers of one block.
struct ReceiverBlock {
    std::span<const Receiver> receivers;
    std::uint64_t wanted = ~std::uint64_t(0); ///< bits: receivers that need an entry
    std::uint32_t key = 0;                    ///< of the first; names it in every scene that has it
    std::uint64_t some = ~std::uint64_t(0);   ///< bits: of which entries are brought up to date
};

/// An object that is not where it was.
struct MovedObject {
    std::uint32_t object = 0;
    bool present = true;
    Bounds box; ///< where it is now, a hair more [m, world]
};

bool isAmong(std::span<const MovedObject> moved, std::uint32_t object);
/// Whether any of them may stand between a receiver and what lies in a box [m, world].
bool mayStandBefore(std::span<const MovedObject> moved, const Receiver& receiver,
                    const Bounds& box);

/// Rays that were traced.
struct RayCount {
    std::uint64_t full = 0;   ///< against the whole scene
    std::uint64_t single = 0; ///< against one object
    std::uint64_t total() const { return full + single; }
    RayCount& operator+=(const RayCount& other) {
        full += other.full;
        single += other.single;
        return *this;
    }
    friend RayCount operator-(RayCount a, const RayCount& b) {
        return {a.full - b.full, a.single - b.single};
    }
};

/// Builds and updates one block of one row at a time; one builder a thread, for it owns scratch
/// space. An updated block is the same as a block built anew, but for the choice among several
/// objects that block a sample:
///
/// - samples that a moved object blocked are traced again;
/// - samples that were visible are traced against the moved objects alone;
/// - what something else blocks stays blocked.
class RowBuilder {
public:
    explicit RowBuilder(const RayScene& rays) : rays_(rays), drafts_(RowBlock::kSize) {}

    /// Indirect light: a patch or a cluster onto up to 64 receivers. The number of samples follows
    /// the form factor (1, 4 or 16); which ones is a fixed function of the pair's keys.
    void patchBlock(const PatchSender& sender, const ReceiverBlock& receivers, RowBlock& block);

    /// Brings a block up to date: direct light from an emitter, of some of its entries, or indirect
    /// light from a patch.
    /// \param anew bits: entries to be evaluated anew
    /// \return the number of entries that are not what they were
    int updateEmitterBlock(const EmitterSender& sender, const ReceiverBlock& receivers,
                           std::uint64_t anew, std::span<const MovedObject> moved, RowBlock& block);
    int updatePatchBlock(const PatchSender& sender, const ReceiverBlock& receivers,
                         std::uint64_t anew, std::span<const MovedObject> moved, RowBlock& block);

    /// How many samples of an emitter's entry are on record.
    static int samplesTaken(const EmitterSender& sender, const RowBlock::Draft& draft);

    /// Rays since the last call.
    RayCount takeRayCount() { return std::exchange(rayCount_, {}); }

private:
    /// A sample of an entry that is being worked on.
    struct PatchRay {
        std::uint8_t receiver, sample;
        float weight;          ///< share of the pair's samples
        std::uint32_t blocker; ///< ObjectId::kNone: visible
    };
    void emitterEntry(const EmitterSender& sender, const Receiver& receiver,
                      RowBlock::Draft& draft);
    bool retestEmitterEntry(const EmitterSender& sender, const Receiver& receiver,
                            std::span<const MovedObject> moved, RowBlock::Draft& draft);
    bool openPatchEntry(const PatchSender& sender, const Receiver& receiver,
                        RowBlock::Draft& draft);
    void listPatchRays(const PatchSender& sender, const ReceiverBlock& receivers, std::size_t r);
    void collectPatchRays(const PatchSender& sender, const Receiver& receiver, std::size_t first,
                          std::size_t last);
    void collectPatchRays(const PatchSender& sender, const ReceiverBlock& receivers);
    template <class Choose>
    void tracePatchRays(const PatchSender& sender, const ReceiverBlock& receivers, Choose choose,
                        const MovedObject* alone);

    const RayScene& rays_;
    std::vector<RowBlock::Draft> drafts_;
    std::vector<PatchRay> patchRays_;
    RayCount rayCount_;
};

} // namespace penumbra
