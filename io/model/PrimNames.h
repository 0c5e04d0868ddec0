// Names of prims from names of anything.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>

namespace penumbra {

/// `text` as a name that every USD program accepts: letters, digits and underscores of ASCII, no
/// digit first; each other character becomes an underscore. `fallback` if nothing is left.
std::string primName(std::string_view text, std::string_view fallback);

/// The names below one prim.
class PrimNames {
public:
    /// primName(), with a number if it is taken.
    std::string take(std::string_view wanted, std::string_view fallback);

private:
    std::unordered_map<std::string, std::size_t> taken_; // with the last number given to it
};

/// Keeps the name that something had, if its prim has another one.
void keepDisplayName(UsdPrimSpec& spec, std::string_view original);

/// `text` as valid UTF-8 on one line: what isn't becomes '?'.
std::string cleanText(std::string_view text);

} // namespace penumbra
