// How equal preview lighting and radiosity are where no shadow falls.
#pragma once

#include "viewer/preview/LightBlend.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <string>

namespace penumbra {

/// |preview - radiosity| / radiosity of the direct light of pixels at whose triangles' corners
/// nothing is in the way of the lights, scene at rest, in float.
struct Consistency {
    std::size_t lights = 0; ///< that were compared, as many at a time as are previewed at most
    std::size_t pixels = 0; ///< of all these times, in no shadow
    double mean = 0, median = 0, p99 = 0, most = 0;
    double beyond = 0; ///< share of pixels above 1 %
};

/// \param scene one of scenes/*.usda, without its ending, seen by its first camera
/// \param elementSize [m]; 0: the scene's
Consistency consistency(const std::string& scene, PreviewMethod by, float elementSize,
                        glm::ivec2 size);

} // namespace penumbra
