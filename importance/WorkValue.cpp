#include "importance/WorkValue.h"

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
double visiblePixels(const WorkPlace& place, Viewpoint::Region region, const Attention& attention,
                     std::optional<float> seen) {
    const ValueFactors& factors = attention.factors;
    const Viewpoint& viewpoint = attention.viewpoint;
    const double whole = viewpoint.pixelsOf(place.box, glm::vec3(0), 4 * place.area);
    const double shown = viewpoint.pixelsOf(place.box, place.normal, place.area);
    const double pixels = factors.size ? std::max({shown, kTurnedAway * whole, 1e-6}) : 1;
    if (region == Viewpoint::Region::margin) return kMargin * pixels;
    if (region == Viewpoint::Region::elsewhere) return kElsewhere * pixels;
    if (!factors.occlusion || !seen) return pixels;
    if (!factors.size) return *seen > 0 ? 1 : kHidden;
    return *seen + kHidden * std::max(0.0, pixels - *seen);
}

} // namespace

PlaceValue placeValue(const WorkPlace& place, const Attention& attention,
                      std::optional<float> seen) {
    const ValueFactors& factors = attention.factors;
    PlaceValue value;
    const Viewpoint::Region region =
        factors.frustum ? attention.viewpoint.regionOf(place.box) : Viewpoint::Region::picture;
    value.inPicture = region == Viewpoint::Region::picture;
    value.weight = visiblePixels(place, region, attention, seen);
    value.anyChange = !factors.change;
    if (factors.eccentricity) {
        const glm::dvec3 direction = attention.viewpoint.towards(place.box.centre());
        value.weight *= peripheralSensitivity(attention.gaze.eccentricity(direction));
    }
    if (factors.proximity && attention.moved)
        value.weight *= proximityWeight(distanceBetween(place.box, *attention.moved));
    if (factors.contrast) {
        const double adapted = localAdaptation(place.luminance, attention.adaptation);
        value.perThreshold = peakContrastSensitivity(adapted) / adapted;
    }
    return value;
}

double workValue(const PlaceValue& place, double change, double cost) {
    assert(change >= 0 && cost > 0);
    if (place.anyChange) return place.weight / cost;
    const double steps = change * place.perThreshold;
    return place.weight * steps * steps / (steps + 1) / cost;
}

} // namespace penumbra
