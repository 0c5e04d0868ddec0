// What to expect of open work on direct light, before it is done: a few rays where it takes many.
#pragma once

#include "radiosity/EmitterSender.h"
#include "radiosity/OpenWork.h"
#include "radiosity/RayScene.h"
#include "radiosity/Row.h"
#include "radiosity/RowBuilder.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace penumbra {

/// Takes samples of a block's entries, one of each of up to 16 receivers, and compares what was
/// stored of them with what they are now:
///
/// - a sample that was visible is hidden if it meets a moved object where that stands now;
/// - a sample that a moved object hid is visible if it meets none of them: what else may hide it is
///   not looked for;
/// - a sample that something else hides stays hidden;
/// - an entry that is to be evaluated anew is: form factor, and one sample against the whole scene,
///   against F V as it was. So what goes dark counts as much as what becomes light.
///
/// The first three cost rays against single objects. What is found is unbiased but for the second,
/// and decides about an order only. One look a thread at a time, for it owns scratch space.
///
/// It is the estimate from stored blockers of [MuellerSchoeffel1994]'s list, with rays against the
/// moved object alone.
class ChangeLook {
public:
    static constexpr std::size_t kCost = 40; ///< of a look, about [rays]

    explicit ChangeLook(const RayScene& rays) : rays_(rays), drafts_(RowBlock::kSize) {}

    /// \param anew bits: entries to be evaluated anew; \param moved as for RowBuilder
    ExpectedFactor at(const EmitterSender& sender, const ReceiverBlock& receivers,
                      std::uint64_t anew, std::span<const MovedObject> moved,
                      const RowBlock& block);

    /// Rays since the last call.
    RayCount takeRayCount() { return std::exchange(rayCount_, {}); }

private:
    /// One sample of one receiver.
    struct Probe {
        float before = 0, unoccluded = 0; ///< F V that was known of it; F now
        bool anew = false;
    };
    void probe(int lane, const EmitterSender& sender, const ReceiverBlock& receivers,
               std::size_t receiver, int sample, bool anew, std::span<const MovedObject> moved);
    void trace(std::span<const MovedObject> moved);
    ExpectedFactor summary() const;

    const RayScene& rays_;
    std::vector<RowBlock::Draft> drafts_;
    Probe probes_[ShadowRays::kMost];
    ShadowRays whole_, alone_; ///< against the whole scene; against moved objects
    /// Bits: probes of which the sample is hidden; was hidden by what moved; that took a ray.
    std::uint32_t hidden_ = 0, released_ = 0, traced_ = 0;
    int count_ = 0; ///< of receivers that were probed
    RayCount rayCount_;
};

} // namespace penumbra
