// Objects that come to a patch set.
#pragma once

#include "radiosity/mesh/BuildPatches.h"

#include <optional>

namespace penumbra {

/// Makes room in a set for an eighth as much as it has, and for what is usual in a room at least.
/// \pre the set was just meshed
void makeRoom(PatchSet& set);

/// Appends the objects of a set that was just meshed alone to another one, hidden: their vertices,
/// nodes and patches where there is room for them, all else at the end. What is there keeps its
/// numbers.
/// \param from is used up
/// \return what they are called now, in their order; nothing, and nothing is changed, if there is
/// not room enough
std::optional<std::vector<ObjectId>> addObjects(BuiltPatches& to, BuiltPatches& from);

} // namespace penumbra
