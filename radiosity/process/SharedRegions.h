// Memory that two processes see.
#pragma once

#include "radiosity/process/Region.h"

#include <memory>

namespace penumbra {

/// POSIX shared memory. Names can't be guessed, and nobody but the user who runs this may open what
/// they name (mode 0600). Memory is there when reserve() says so, or when it is written to.
std::unique_ptr<Regions> makeSharedRegions();

/// Names begin with the process that made them. Removes those of a process that has ended without
/// being able to.
void removeRegionsOf(int process);
/// The same for all processes that are no more.
void removeOrphanedRegions();

} // namespace penumbra
