// Nothing of a model is used before it was checked here.
#pragma once

#include <cstddef>
#include <string>

struct aiScene;

namespace penumbra {

/// Deepest nodes of nodes, in models of any format.
inline constexpr std::size_t kMostNested = 500;

/// Refuses what later code would stumble over: nodes too deep or too many, indices of meshes,
/// materials, points and children out of range, points and matrices that are not finite. Throws
/// SceneFileError.
void checkModel(const aiScene& scene, const std::string& file);

} // namespace penumbra
