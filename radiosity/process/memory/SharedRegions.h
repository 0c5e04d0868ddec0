// Memory that two processes see.
#pragma once

#include "radiosity/process/memory/Region.h"

#include <memory>

namespace penumbra {

/// Files of Linux that are nothing but memory (memfd): they are in no folder, and end with the last
/// process that has them open or mapped, however that ends. Their size is sealed: nobody can take
/// memory away that its peer is about to read. A name says which process has which file open,
/// with 128 random bits; only processes of the same user find it there.
std::unique_ptr<Regions> makeSharedRegions();

} // namespace penumbra
