// Cameras of models as cameras of USD.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <glm/glm.hpp>

#include <string>

struct aiCamera;

namespace penumbra {

/// A camera in the frame of its node.
struct ModelCamera {
    std::string name;
    glm::dmat4 toNode{1};         ///< it looks along -Z, Y is up
    double verticalFov = 0;       ///< the whole angle [rad]; 0: unknown
    double aspect = 0;            ///< width by height; 0: unknown
    double orthographicWidth = 0; ///< of the picture, in units of the file; 0: perspective
    double nearPlane = 0;         ///< in units of the file
    double farPlane = 0;          ///< the same; not beyond the near one: there is no end
};

ModelCamera modelCameraOf(const aiCamera& camera);

/// What is unknown is 16:9, 60 degrees wide, or not said.
UsdPrimSpec cameraPrim(const ModelCamera& camera, const std::string& name);

} // namespace penumbra
