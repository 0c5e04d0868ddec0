// Illuminance at a point, evaluated there instead of interpolated.
#pragma once

#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/query/DrawnSurface.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/ClusterParts.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/HemisphereRays.h"
#include "radiosity/transport/Solver.h"

#include <unordered_map>
#include <vector>

namespace penumbra {

/// Gathers light at single points: from the emitters by closed form and many shadow rays, from the
/// solved patches (their elements, where they are near) by closed form and rays. Where something is
/// nearer than elements can tell, in gaps and corners, paths are followed instead: drawn light is
/// wrong in a slit narrower than an element, so that of near surfaces is never used.
class PointGather {
public:
    /// All must outlive this. Element counts as visible if its middle is.
    PointGather(const PatchSet& patches, const RayScene& rays, const Lighting& lighting);

    Rgb direct(const Receiver& receiver) const;   ///< [lux]
    Rgb indirect(const Receiver& receiver) const; ///< [lux]

private:
    float patchFactor(std::uint32_t index, const Receiver& receiver) const;
    float patchVisibility(std::uint32_t index, const Receiver& receiver) const;
    bool somethingNear(const Receiver& receiver) const;
    Rgb indirectByForm(const Receiver& receiver) const;
    Rgb indirectByPaths(const Receiver& receiver) const;
    Rgb drawnAt(const DrawnHit& hit) const;
    Receiver receiverAt(const DrawnHit& hit, glm::vec3 position) const;
    Rgb directFrom(const Receiver& receiver, int shadowSamples) const;

    const PatchSet& patches_;
    const RayScene& rays_;
    const Lighting& lighting_;
    DrawnSurface surface_;
    HemisphereRays probes_, paths_;
    std::vector<EmitterSender> emitters_;
    std::vector<Rgb> elementRadiosity_; ///< rho H, own emission left out [lm/m^2]
    std::vector<Rgb> patchRadiosity_;
    std::vector<float> patchRadius_;
    std::vector<glm::vec3> patchSamples_;
    std::unordered_map<std::uint32_t, std::array<SenderPart, kPatchSamples>> clusterParts_;
};

} // namespace penumbra
