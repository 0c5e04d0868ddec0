// What to expect of a dirty block of direct light, before it is updated: one ray where an update
// takes many.
#pragma once

#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/Row.h"
#include "radiosity/rows/RowBuilder.h"
#include "radiosity/schedule/DirtySet.h"
#include "radiosity/schedule/KernelEstimate.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// Says of each entry of a block how far F V may be expected to change, from what is stored of it
/// and a ray or two:
///
/// - of the samples that were visible, those that point at a moved object's box where it is now
///   are hidden if one of them is found to meet the object;
/// - the samples that a moved object hid are visible if one of them is found to meet none of them:
///   what else may hide it is not searched for;
/// - the samples that something else hides stay hidden;
/// - an entry that is not wanted any more goes;
/// - an entry that is to be evaluated anew has its form factor. A sample that was visible, one that
///   was not, and one of an entry that was not there, each of one receiver in eight, are traced
///   against the whole scene, and tell how many stay so. So the probe finds what goes dark, what
///   becomes light, and what does not change.
///
/// A single ray says yes or no. What is expected goes by its neighbours as well, see
/// KernelEstimate: half-shadows are as wide as a few receivers.
///
/// An entry of which nothing points at a moved object, and no sample was hidden by one, stays what
/// it is: there is nothing to be done. What is found decides about priorities only. One probe a
/// thread, for it owns scratch space.
///
/// It is the estimate from stored blockers of [MuellerSchoeffel1994]'s list, with rays against the
/// moved object alone.
class ChangeProbe {
public:
    explicit ChangeProbe(const RayScene& rays) : rays_(rays), drafts_(RowBlock::kSize) {}

    /// \param receivers with those of which anything is to be known
    /// \param anew bits: entries to be evaluated anew; \param moved as for RowBuilder
    ExpectedFactors at(const EmitterSender& sender, const ReceiverBlock& receivers,
                       std::uint64_t anew, std::span<const MovedObject> moved,
                       const RowBlock& block);

    /// See RowBuilder::occluders: of the block that is being probed.
    std::vector<ObjectId> occluders;

    /// Rays since the last call.
    RayCount takeRayCount() { return std::exchange(rayCount_, {}); }

private:
    /// What is known of an entry before its rays are traced.
    struct Probe {
        float before = 0, now = 0;        ///< F V that was; F
        float visible = 0;                ///< V that was
        float covered = 0, uncovered = 0; ///< shares of the samples that may become hidden; visible
    };
    /// Bits: receivers of which a ray was traced, and those of which it was blocked.
    struct Asked {
        std::uint64_t all = 0, blocked = 0;
    };
    /// Of samples that were visible, and of those that were not.
    struct Answers {
        Asked covered, uncovered;
    };
    /// Rays that wait for company.
    struct Packet {
        ShadowRays rays;
        std::array<Asked*, ShadowRays::kMost> answers; ///< where to say that a ray is blocked,
        std::array<std::size_t, ShadowRays::kMost> receivers; ///< and of which receiver
        int count = 0;
    };
    /// What is on record of an entry: samples that moved objects block, and that others do.
    struct Recorded {
        std::uint64_t byMoved = 0, byOthers = 0;
    };
    Recorded recordedIn(const RowBlock::Draft& draft, std::span<const MovedObject> moved) const;
    bool coversFurther(const EmitterSender& sender, const Receiver& receiver,
                       const RowBlock::Draft& draft, const Recorded& recorded,
                       std::span<const MovedObject> moved) const;
    bool probeStored(const EmitterSender& sender, const Receiver& receiver, std::size_t r,
                     std::span<const MovedObject> moved, float& rays);
    bool probeAnew(const EmitterSender& sender, const ReceiverBlock& receivers, std::size_t r,
                   float& rays);
    float changeOf(std::size_t r, const Answers& answers, const KernelEstimate& share) const;
    void add(Packet& packet, const SampleGroup& group, std::uint32_t samples, std::size_t receiver,
             Asked& asked, std::span<const MovedObject> moved);
    void trace(Packet& packet, std::span<const MovedObject> moved);

    const RayScene& rays_;
    std::vector<RowBlock::Draft> drafts_;
    std::array<Probe, RowBlock::kSize> probes_;
    Answers stored_, anew_, fresh_; ///< of entries that stay; are evaluated anew; were not there
    Packet whole_, alone_;          ///< against the whole scene; against moved objects
    RayCount rayCount_;
};

} // namespace penumbra
