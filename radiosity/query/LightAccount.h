// Why it is dark here: what every light would give to a point, what arrives, and who takes the
// rest.
#pragma once

#include "base/ObjectId.h"
#include "base/Rgb.h"
#include "radiosity/mesh/PatchSet.h"
#include "radiosity/query/DrawnSurface.h"
#include "radiosity/transport/DirectLight.h"

#include <string>
#include <vector>

namespace penumbra {

/// What one object takes of a light.
struct LightLoss {
    ObjectId object;
    Rgb lux;
};

/// What a light does at a point: unoccluded = arrives + the sum of the losses, to rounding.
struct EmitterAccount {
    std::string path;              ///< of the light or the emissive mesh in the scene
    Rgb unoccluded;                ///< if nothing stood in the way [lux]
    Rgb arrives;                   ///< as it is drawn [lux]
    std::vector<LightLoss> losses; ///< one an object, the largest first

    Rgb lost() const { return unoccluded - arrives; }
};

/// The direct light of a point of the drawn surface, light by light: who loses most comes first,
/// then who gives most. Read off the rows of the shadow-form-factor-list; nothing is traced.
///
/// Between the corners c of the drawn triangle, with barycentric weights b, and the light's
/// emitters e of exitance E:
///
///     unoccluded = Σc Σe b F E,   arrives = Σc Σe b F V E,   loss of object o = Σc Σe b F Wo E
///
/// where Wo is the share of the visibility samples, by their weights, that o was found to block:
/// the sum of all Wo is 1 - V. A sample that several objects hide is charged to one of
/// them, so that taking this one away alone need not bring the light back. Where a wall hides the
/// whole light there is no entry, and the wall is charged with all of it.
///
/// \param light worked off: its rows are those of `patches` as it is now
/// \param at    a point that was met
std::vector<EmitterAccount> accountForLight(const PatchSet& patches, const DirectLight& light,
                                            const DrawnHit& at);

} // namespace penumbra
