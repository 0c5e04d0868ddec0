// What lighting a scene will take, for people.
#pragma once

#include "io/usd/scene/UsdScene.h"
#include "scenegraph/Objects.h"
#include "tools/SceneSolution.h"

namespace penumbra {

/// Meshes the scene as it would be lit, traces samples and prints what to expect. Nothing is lit.
/// \throws Error if it can't be meshed
void printCost(const SolveSettings& settings, const LoadedScene& loaded, const PlacedScene& placed);

} // namespace penumbra
