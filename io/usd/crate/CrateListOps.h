// List edits of fields: tokens, paths, references.
#pragma once

#include "io/usd/crate/CrateFile.h"
#include "io/usd/layer/UsdLayer.h"

namespace penumbra {

/// Each reads what a representation stands for, or throws CrateFault.

/// Of tokens, strings or paths. An empty or impossible path is left out.
UsdListEdits<std::string> crateTextEdits(CrateFile& file, CrateRep rep);
/// Of references or payloads; also a single payload, as old files have it.
UsdListEdits<UsdReference> crateReferenceEdits(CrateFile& file, CrateRep rep);
/// Of any list, each item as the text format writes it: what metadata of kinds unknown to us keeps.
UsdListEdits<std::string> crateWrittenEdits(CrateFile& file, CrateRep rep);

/// Whether a value is a list edit at all.
bool isCrateListOp(CrateType type);

} // namespace penumbra
