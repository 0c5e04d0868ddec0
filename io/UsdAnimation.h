// Playing the time samples of a loaded scene.
#pragma once

#include "scenegraph/Scene.h"

#include <memory>

namespace penumbra {

/// What changes with time in a scene that was loaded from USD: transforms, the luminance of lights,
/// the constants of materials, lenses. Geometry, sizes of lights and visibility are held.
class UsdAnimation {
public:
    virtual ~UsdAnimation() = default;
    /// Brings the scene to a time code. Only nodes whose value really changes are edited, so that
    /// their revisions tell what has to be computed anew.
    virtual void setTime(double timeCode) = 0;
};

} // namespace penumbra
