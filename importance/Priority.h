// The priority of a piece of work: what the viewer gains from it for its cost.
#pragma once

#include "base/Bounds.h"
#include "importance/Gaze.h"
#include "importance/Viewpoint.h"

#include <glm/glm.hpp>

#include <optional>

namespace penumbra {

/// A small surface whose light is worked on as one: what the viewer has to know of it.
struct ReceiverCluster {
    Bounds box;            ///< [m, world]
    glm::vec3 normal{0};   ///< mean of its unit normals; see Viewpoint::pixelsOf()
    float area = 0;        ///< [m^2]
    float luminance = 0;   ///< that it shows now [nit]
    float reflectance = 0; ///< photometric, in [0, 1]
};

/// Which of the factors count: all of them, unless somebody measures what each contributes.
struct PriorityFactors {
    bool change = true;       ///< how far the light may change; else all changes count alike
    bool probe = true;        ///< a probe says what to expect of work; else all that is possible
    bool contrast = true;     ///< what of it can be seen at all; else luminance counts as it is
    bool size = true;         ///< how many pixels it covers
    bool frustum = true;      ///< whether it is in the picture
    bool occlusion = true;    ///< whether something stands in front of it
    bool eccentricity = true; ///< how far it is from the centre of gaze
    bool proximity = true;    ///< how near it is to what is being moved
};

/// All that a priority depends on besides the work itself.
struct Attention {
    Viewpoint viewpoint;
    Gaze gaze;
    double adaptation = 100;     ///< see Adaptation [nit]
    std::optional<Bounds> moved; ///< the object being moved [m, world]
    PriorityFactors factors;
    bool whole = false; ///< blocks are shown as wholes: none is done in parts
};

/// The part of a priority that all work of one receiver cluster shares.
struct ClusterPriority {
    double weight = 0; ///< pixels, those that are hidden or far from the gaze counted for less
    double perThreshold = 1; ///< reciprocal of the luminance step that is just seen here [1/nit]
    bool anyChange = false;  ///< changes of any size count alike
    bool inPicture = true;   ///< or may be; else all of it is seen only when the viewer turns
};

/// \param seen what an item buffer says of the cluster [pixels], see SeenItems.h; without one, what
///             is in the picture counts as seen
ClusterPriority clusterPriority(const ReceiverCluster& cluster, const Attention& attention,
                                std::optional<float> seen = {});

/// Expected visible gain per expected cost of a piece of work:
///
///     value = weight * g(change / threshold) / cost        g(x) = x^2 / (x + 1)
///
/// The order that this makes is decision theory's: benefit over cost (Dumont, Pellacini & Ferwerda,
/// ACM TOG 22(2), 2003). g is linear for what is clearly visible and quadratic for what is too
/// faint to be seen by itself, so that no priority is ever 0 for that.
///
/// \param change expected or greatest change of luminance [nit], >= 0
/// \param cost   expected, in any one unit, > 0
/// \return       >= 0; rises with change and falls with cost
double priorityOf(const ClusterPriority& cluster, double change, double cost);

} // namespace penumbra
