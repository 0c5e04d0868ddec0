// From which camera of a scene a picture is taken.
#pragma once

#include "scenegraph/Camera.h"
#include "scenegraph/Objects.h"
#include "scenegraph/Scene.h"

#include <string>
#include <vector>

namespace penumbra {

/// The camera that was asked for by its path, or the first one; null if there is none at all.
/// \param file of the scene, for the message about an unknown path \throws SceneFileError
const Placed<Camera>* chooseCamera(const PlacedScene& placed, const std::string& path,
                                   const std::string& file);

/// Height of a picture of `width` pixels, as the chosen camera's film is shaped (16:9 without one).
int heightFor(const PlacedScene& placed, const std::string& path, const std::string& file,
              int width);

/// The view of the chosen camera; without any, the whole scene is framed from above.
View viewOf(const PlacedScene& placed, UpAxis up, const std::string& path, const std::string& file,
            int width, int height);

/// Names of cameras for files: the last part of each path; all parts, joined by '-', where others
/// among them end in the same.
std::vector<std::string> namesForFiles(const std::vector<std::string>& cameras);

/// Replaces each "{camera}" in the name of a file by a camera's name.
std::string withCamera(std::string pattern, const std::string& name);

} // namespace penumbra
