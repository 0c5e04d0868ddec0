// An emitter made ready to send light to receivers.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/PolygonTree.h"

#include <optional>
#include <vector>

namespace penumbra {

/// 16 visibility samples of an emitter as one receiver sees them.
struct SampleGroup {
    ShadowRays rays;              ///< to the samples that count
    alignas(64) float weight[16]; ///< cos cos / d^2, common factors left out; 0: does not count

    /// Adds the weights of the samples that are used, and of those among them that nothing blocks.
    /// \pre rays are traced
    void add(float& total, float& seen) const;
};

/// An emitter with its visibility samples.
class EmitterSender {
public:
    /// \param baseSamples samples of a pair that are always taken; rounded up to a multiple of 16
    /// \param allSamples  samples of a pair whose first ones disagree, likewise
    EmitterSender(const Emitter& emitter, int baseSamples, int allSamples);

    const Emitter& emitter() const { return *emitter_; }
    int baseSamples() const { return base_; }
    int allSamples() const { return all_; }
    /// Around all that a visibility sample may lie on [m, world].
    const Bounds& box() const { return box_; }

    /// What the whole emitter gives to a receiver when nothing stands between them: the closed
    /// forms of FormFactor.h, summed over polygons; of many, those that are far send together.
    /// Exact for convex emitters of few; polygons that shade each other are found by the
    /// visibility samples.
    float formFactor(const Receiver& receiver) const;

    /// Samples first ... first + 15 for a receiver. A sphere is sampled on the part that faces it.
    void sampleGroup(const Receiver& receiver, int first, SampleGroup& group) const;

    /// Weighted share of samples first ... first + count - 1 that a receiver sees, in [0, 1].
    float visibility(const RayScene& rays, const Receiver& receiver, int first, int count) const;

private:
    void sphereGroup(const Receiver& receiver, int first, SampleGroup& group) const;

    const Emitter* emitter_;
    int base_, all_;
    Bounds box_;
    std::optional<PolygonTree> many_;             ///< of an emitter of many polygons
    std::vector<float> x_, y_, z_, nx_, ny_, nz_; ///< of the samples
};

} // namespace penumbra
