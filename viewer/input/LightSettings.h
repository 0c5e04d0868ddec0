// The one place where settings of the light are resolved: what is asked for, else what the file
// asks for, else a default that follows the scene.
#pragma once

#include "base/LightRequest.h"
#include "io/usd/scene/UsdScene.h"

#include <optional>
#include <string>

namespace penumbra {

/// What is asked for, else what the file asks for; and a patch size in any case: else the one that
/// follows the scene as it is at its start, the same for every frame that one begins with.
/// What is still empty is up to optionsFor().
///
/// \param loaded  from `file`, at `frame`
/// \param frame   time code; none: the file's start. For another one the file is read once more,
///                unless it or `asked` says a patch size
/// \throws        Error if the file can't be read any more
LightRequest lightSettings(const std::string& file, const LoadedScene& loaded,
                           std::optional<double> frame, const LightRequest& asked);

} // namespace penumbra
