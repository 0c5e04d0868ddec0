// What the window says of the light, in words.
#pragma once

#include "radiosity/process/RadiosityState.h"

#include <string>

namespace penumbra {

/// How far it is: what is being done, or the state of the solution, for the status line.
std::string lightWords(const RadiosityState& light);

/// What the light may still be wrong by, from the certificate; empty while nothing is lit.
std::string errorWords(const RadiosityState& light);

} // namespace penumbra
