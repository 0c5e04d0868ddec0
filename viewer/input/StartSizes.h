// How finely a file's scene is meshed, whatever frame of it is shown.
#pragma once

#include "io/usd/scene/UsdScene.h"
#include "radiosity/mesh/BuildPatches.h"

#include <optional>
#include <string>

namespace penumbra {

/// The sizes that are asked for, else those that the file asks for, else, of patches, the one that
/// follows the scene as it stands at its start: the same for every frame that one begins with.
///
/// \param loaded  from `file`, at `frame`
/// \param frame   time code; none: the file's start. For another one the file is read once more,
///                unless it or `asked` says a patch size
/// \return        elementSize 0: nobody asked for one, see MeshingOptions
/// \throws        Error if the file can't be read any more
MeshingOptions startSizes(const std::string& file, const LoadedScene& loaded,
                          std::optional<double> frame, MeshingOptions asked);

} // namespace penumbra
