// A scene of scenes/, read.
#pragma once

#include "viewer/input/SceneLoader.h"

#include <string>

namespace penumbra {

/// \param scene name of a file there, without its ending \throws Error
ReadyScene loadScene(const std::string& scene);

} // namespace penumbra
