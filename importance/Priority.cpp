#include "importance/Priority.h"

#include "importance/Adaptation.h"
#include "importance/ContrastSensitivity.h"
#include "importance/Proximity.h"

#include <algorithm>
#include <cassert>

namespace penumbra {

namespace {

// Off the screen is seen when the head turns, hidden things when they or the viewer move: how much
// that counts is a matter of taste, that it counts for less by orders of magnitude is not.
constexpr double kHidden = 0.005, kMargin = 0.001, kElsewhere = 0.0001;
constexpr double kTurnedAway = 0.02; ///< of a surface's pixels if it faced the viewer

/// The pixels at stake, fewer for those that are not seen now.
double visiblePixels(const ReceiverCluster& cluster, Viewpoint::Region region,
                     const Attention& attention, std::optional<float> seen) {
    const PriorityFactors& factors = attention.factors;
    const Viewpoint& viewpoint = attention.viewpoint;
    const double whole = viewpoint.pixelsOf(cluster.box, glm::vec3(0), 4 * cluster.area);
    const double shown = viewpoint.pixelsOf(cluster.box, cluster.normal, cluster.area);
    const double pixels = factors.size ? std::max({shown, kTurnedAway * whole, 1e-6}) : 1;
    if (region == Viewpoint::Region::margin) return kMargin * pixels;
    if (region == Viewpoint::Region::elsewhere) return kElsewhere * pixels;
    if (!factors.occlusion || !seen) return pixels;
    if (!factors.size) return *seen > 0 ? 1 : kHidden;
    return *seen + kHidden * std::max(0.0, pixels - *seen);
}

} // namespace

ClusterPriority clusterPriority(const ReceiverCluster& cluster, const Attention& attention,
                                std::optional<float> seen) {
    const PriorityFactors& factors = attention.factors;
    ClusterPriority value;
    const Viewpoint::Region region =
        factors.frustum ? attention.viewpoint.regionOf(cluster.box) : Viewpoint::Region::picture;
    value.inPicture = region == Viewpoint::Region::picture;
    value.weight = visiblePixels(cluster, region, attention, seen);
    value.anyChange = !factors.change;
    if (factors.eccentricity) {
        const glm::dvec3 direction = attention.viewpoint.towards(cluster.box.centre());
        value.weight *= peripheralSensitivity(attention.gaze.eccentricity(direction));
    }
    if (factors.proximity && attention.moved)
        value.weight *= proximityWeight(distanceBetween(cluster.box, *attention.moved));
    if (factors.contrast) {
        const double adapted = localAdaptation(cluster.luminance, attention.adaptation);
        value.perThreshold = peakContrastSensitivity(adapted) / adapted;
    }
    return value;
}

double priorityOf(const ClusterPriority& cluster, double change, double cost) {
    assert(change >= 0 && cost > 0);
    if (cluster.anyChange) return cluster.weight / cost;
    const double steps = change * cluster.perThreshold;
    return cluster.weight * steps * steps / (steps + 1) / cost;
}

} // namespace penumbra
