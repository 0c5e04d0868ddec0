// The rays of direct light, traced and nothing else: what the solver's time is compared with.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/rows/EmitterSender.h"
#include "radiosity/rows/Walls.h"
#include "radiosity/transport/Solver.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace penumbra {

/// Repeats the shadow rays of DirectLight::work(): the same segments, in the same packets and
/// order, on as many threads. They are made in advance, a chunk of receivers at a time, and only
/// tracing is timed.
class BareTracing {
public:
    struct Seconds {
        double rayScene = 0, rayCpu = 0;  ///< in RayScene::occluded(): wall, processor time
        double embree = 0, embreeCpu = 0; ///< in rtcOccluded16() alone: packets ready, no filter
        std::uint64_t rays = 0;
    };

    /// Both must outlive this. A second Embree scene is built: it has the flags of RayScene's, and
    /// no filter.
    BareTracing(const PatchSet& patches, const RayScene& rays, const SolverOptions& options);
    ~BareTracing();
    BareTracing(const BareTracing&) = delete;
    BareTracing& operator=(const BareTracing&) = delete;

    Seconds measure() const;

private:
    struct EmbreeScene;
    using Packets = std::vector<ShadowRays>;
    Packets packetsOf(std::size_t firstReceiver, std::size_t lastReceiver) const;

    const PatchSet& set_;
    const RayScene& rays_;
    Walls walls_;
    std::vector<EmitterSender> senders_;
    std::unique_ptr<EmbreeScene> embree_;
};

} // namespace penumbra
