// Playing the time samples of a loaded scene.
#pragma once

#include "scenegraph/Scene.h"

#include <memory>

namespace penumbra {

/// What changes with time in a scene that was loaded from USD: transforms, visibility, the
/// luminance of lights, the constants of materials, lenses. Geometry and sizes of lights are held.
///
/// A prim whose visibility has time samples becomes a Switch of its name with a nameless Transform
/// below that begins an object, so that it comes and goes as one.
class UsdAnimation {
public:
    virtual ~UsdAnimation() = default;
    /// Brings the scene to a time code. Only nodes whose value really changes are edited, so that
    /// their revisions tell what has to be computed anew.
    virtual void setTime(double timeCode) = 0;
};

} // namespace penumbra
