// Changes USD text as its grammar is built: by tokens and by pairs of brackets.
#pragma once

#include "tests/fuzz/FuzzRandom.h"

#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

/// The text with one change: a token or a stretch in brackets taken out, doubled, moved, nested,
/// or put in from `pool`, a number made extreme, or a path replaced by another one of the text.
std::string mutatedText(std::string_view text, const std::vector<std::string>& pool,
                        FuzzRandom& random);

/// Statements of every kind that a layer may have.
const std::vector<std::string>& layerStatements();
/// Arcs, and what belongs to them, among the prims /a to /c and the files 0.usda to 3.usda.
const std::vector<std::string>& arcStatements();

} // namespace penumbra
