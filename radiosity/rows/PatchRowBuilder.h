// Fills rows of indirect light: form factors of patches and clusters, visibility by rays.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayCount.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/ClusterParts.h"
#include "radiosity/rows/MovedObject.h"
#include "radiosity/rows/PartKernels.h"
#include "radiosity/rows/ReceiverBlock.h"
#include "radiosity/rows/Row.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// Many pairs hardly see each other: in a living room three of five have a form factor below
/// kLeastFactor. Some of them stand for all: one of F has an entry of kLeastFactor with the
/// probability F / kLeastFactor, drawn by its keys, and else none ("Russian roulette",
/// [ArvoKirk1990]), so that sums stay what they are in the mean. But a thing of a few centimetres
/// right beside a bulb may light a room, and comes by such entries alone: of what emitters may
/// shine on like that the least is kLeastOfBright. What is below kNoFactor has no entry.
inline constexpr float kLeastFactor = SmallFloat(3e-4f), kLeastOfBright = SmallFloat(1e-5f),
                       kNoFactor = 1e-6f;

/// A patch, or a cluster of patches, made ready to send light to receivers.
struct PatchSender {
    const Patch* patch = nullptr; ///< null: a cluster of patches
    bool cells = false; ///< of a patch: its cells, one around each sample, send unlike each other
    std::span<const glm::vec3> outline; ///< of a patch, but for a cluster of faces
    std::span<const SenderPart> parts;  ///< of a cluster, as many as it has samples
    const glm::vec3* samples =
        nullptr;                 ///< points on the surface [m, world]; kPatchSamples of a patch
    const Bounds* box = nullptr; ///< around all of that [m, world]
    std::uint32_t key = 0;       ///< its address, see PatchSet.h
    float least = kLeastFactor;  ///< its entries' form factors have at least this
    bool allSamples = false;     ///< see samplesFor()

    bool isOfParts() const { return !parts.empty(); }
};

/// Builds and updates one block of a patch's or cluster's row at a time; one builder a thread, for
/// it owns scratch space. RowBuilder says what holds of an updated block.
class PatchRowBuilder {
public:
    explicit PatchRowBuilder(const RayScene& rays)
        : rays_(rays), drafts_(RowBlock::kSize), kernels_(RowBlock::kSize) {}

    /// Evaluates all entries of a block. Their samples are 1, 4 or 16, see samplesFor(); which ones
    /// is a fixed function of the pair's keys.
    void build(const PatchSender& sender, const ReceiverBlock& receivers, RowBlock& block);

    /// Brings a block up to date.
    /// \param anew bits: entries to be evaluated anew
    /// \return the number of entries that are not what they were
    int update(const PatchSender& sender, const ReceiverBlock& receivers, std::uint64_t anew,
               std::span<const MovedObject> moved, RowBlock& block);

    /// Rays since the last call.
    RayCount takeRayCount() { return std::exchange(rayCount_, {}); }

private:
    /// A sample of an entry that is being worked on.
    struct Sample {
        std::uint8_t receiver, index;
        float weight;          ///< share of the pair's samples
        std::uint32_t blocker; ///< ObjectId::kNone: visible
    };
    /// All samples of one entry: a run of samples_.
    struct EntrySamples {
        std::size_t receiver, first, last;
    };
    std::span<RowBlock::Draft> drafts(const ReceiverBlock& receivers) {
        return std::span(drafts_).first(receivers.receivers.size());
    }
    void load(const PatchSender& sender);
    float open(const PatchSender& sender, const Receiver& receiver, std::size_t r);
    bool list(const PatchSender& sender, const ReceiverBlock& receivers, std::size_t r);
    void listSamples(const PatchSender& sender, const ReceiverBlock& receivers, std::size_t r);
    void recallSamples(const PatchSender& sender, const ReceiverBlock& receivers, std::size_t r);
    std::uint64_t listDirty(const PatchSender& sender, const ReceiverBlock& receivers,
                            std::uint64_t anew, std::span<const MovedObject> moved);
    void retrace(const PatchSender& sender, const ReceiverBlock& receivers, std::uint64_t anew,
                 std::span<const MovedObject> moved);
    template <class Choose>
    void trace(const PatchSender& sender, const ReceiverBlock& receivers, Choose choose,
               const MovedObject* alone);
    template <class Visit>
    void forEachEntry(Visit visit) const;
    bool differs(const EntrySamples& entry) const;
    void collect(const PatchSender& sender, const EntrySamples& entry);
    void share(const PatchSender& sender, const EntrySamples& entry);

    const RayScene& rays_;
    float radius2_ = 0; ///< of a planar sender: its farthest corner from its middle, squared [m^2]
    PartTable parts_;   ///< of a sender that has any
    std::vector<RowBlock::Draft> drafts_;
    std::vector<PartKernels> kernels_; ///< by receiver, of those whose samples are listed
    std::vector<Sample> samples_;
    RayCount rayCount_;
};

} // namespace penumbra
