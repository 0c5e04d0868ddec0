// Changes crate files where they say something: within their packed sections.
#pragma once

#include "tests/fuzz/FuzzRandom.h"

#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

/// A crate file with one change inside one of its sections, which are packed again and found again:
/// bytes changed at random would rarely come through the packing. Nothing if the bytes are not
/// such a file.
std::optional<std::string> mutatedCrate(std::string_view file, FuzzRandom& random);

} // namespace penumbra
