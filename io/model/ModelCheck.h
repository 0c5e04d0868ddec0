// Nothing of a model is used before it was checked here.
#pragma once

#include <string>

struct aiScene;

namespace penumbra {

/// Refuses what later code would stumble over: nodes too deep or too many, indices of meshes,
/// materials, points and children out of range, points and matrices that are not finite. Throws
/// SceneFileError.
void checkModel(const aiScene& scene, const std::string& file);

} // namespace penumbra
