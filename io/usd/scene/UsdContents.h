// What is in a scene of which nothing is to be seen.
#pragma once

#include <string>

namespace penumbra {

class UsdStage;

/// For people who wonder: how many prims a stage has, of which types, and how many of them are only
/// classes or overs.
std::string contentsOf(const UsdStage& stage);

} // namespace penumbra
