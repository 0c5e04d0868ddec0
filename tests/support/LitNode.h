// What tests ask of a RadiosityNode: that it gets somewhere, and that its light is right.
#pragma once

#include "radiosity/RadiosityNode.h"

#include <functional>
#include <string>

namespace penumbra {

/// Calls update() until `until` holds; false: it did not within some time.
bool updateUntil(RadiosityNode& node, const std::function<bool()>& until, double seconds = 60);
/// Until the light is that of the graph, and all of it has arrived.
bool updateUntilSettled(RadiosityNode& node, double seconds = 20);

/// Its state and messages, for people.
std::string describe(RadiosityNode& node);

/// What differs between the light below a node and that of a solution from scratch of the graph as
/// it is now, for people; empty: nothing, within the certificates of both and 16-bit floats.
std::string differenceFromScratch(const RadiosityNode& node, const RadiosityOptions& options);

} // namespace penumbra
