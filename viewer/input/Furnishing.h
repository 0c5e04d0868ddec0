// What people bring into a scene and take out of it.
#pragma once

#include "viewer/input/SceneEdit.h"
#include "viewer/input/SceneLoader.h"
#include "viewer/input/Selection.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>

namespace penumbra {

/// The edit that takes a selected thing out of the scene: its object, or, of what belongs to none,
/// the mesh or light. Notes its prim in the scene's addresses, so that the edit can be saved.
/// \param hides see PresenceEdit
/// \return none: it is not there any more
std::optional<PresenceEdit> removalOf(LoadedScene& loaded, const Selection& selection, bool hides);

/// Another one of a thing, not in the scene yet.
struct Duplicate {
    PresenceEdit edit; ///< that brings it in, beside the thing itself
    std::string path;  ///< that it will have
};
/// Makes one, an object with a name of its own (Seat_copy, Seat_copy2, ...). It is written as a
/// reference to the prim of the thing.
/// \param place of the copy in the frame above the thing, from that of the thing
/// \return none: it is not there any more
std::optional<Duplicate> duplicateOf(LoadedScene& loaded, const Selection& selection,
                                     const glm::dmat4& place);

} // namespace penumbra
