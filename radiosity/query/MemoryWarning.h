// What is said when rows of patches do not fit into the memory that they may take.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/transport/IndirectSenders.h"
#include "radiosity/transport/Solver.h"

#include <string>

namespace penumbra {

/// Blocks of nodes that senders are linked to, all together: blocks that all rows have. Of large
/// scenes an estimate, from some hundred blocks.
double countLinks(const PatchSet& set, const IndirectSenders& senders);

/// One line, as soon as a row was not kept: what there is room for, what all rows would take,
/// about, and what to do. Empty before, and where all rows are kept.
std::string memoryWarning(const Solver& solver, const PatchSet& set);

} // namespace penumbra
