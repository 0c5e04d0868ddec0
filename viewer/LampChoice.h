// Which lamps matter to a thing.
#pragma once

#include "scenegraph/Objects.h"
#include "viewer/SceneRays.h"

#include <cstddef>
#include <vector>

namespace penumbra {

/// The lamps to be drawn live while an object moves, the most important ones first: those in it,
/// then those that give it the most light, of which it may take the most away from what lies
/// behind it. Of a lamp that gives E without obstacles and is seen from a share v of the object
/// (its corners and its middle), E v counts; what is less than a twentieth of all is left out, as
/// nobody would see its shadows. Lamps of shapes that can't be drawn live are left out, too.
///
/// \return at most `most` indices into placed.lights
std::vector<std::size_t> lampsThatMatter(const PlacedScene& placed, const SceneRays& rays,
                                         ObjectId object, std::size_t most);

} // namespace penumbra
