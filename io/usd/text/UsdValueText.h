// Values as the USD text format writes them, so that they read back as the same.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <string>
#include <string_view>

namespace penumbra {

/// A value, on one line but for dictionaries and long strings. \param depth of the line it stands
/// on, in steps of four blanks
std::string usdText(const UsdValue& value, std::size_t depth = 0);
void appendUsdText(std::string& out, const UsdValue& value, std::size_t depth);
void appendUsdText(std::string& out, const UsdDictionary& dictionary, std::size_t depth);

/// A string with all that must be escaped; three quotes if it has several lines.
std::string usdLiteral(std::string_view text);
/// Whether a path can be written between @: one with control characters can't, nor one
/// that has an @ and ends with a backslash.
bool isUsdAssetPath(std::string_view path);
/// `@path@`, or as a string where that form can't hold it.
std::string usdAssetLiteral(std::string_view path);

} // namespace penumbra
