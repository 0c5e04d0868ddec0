// Paths of prims and properties.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

/// A letter, an underscore, or any byte of a non-ASCII character (the full rule is Unicode's
/// XID_Start and XID_Continue).
inline bool isUsdIdentifierStart(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}
inline bool isUsdIdentifierPart(char c) {
    return isUsdIdentifierStart(c) || (c >= '0' && c <= '9');
}
bool isUsdIdentifier(std::string_view name);
/// Identifiers joined by single colons.
bool isUsdPropertyName(std::string_view name);

/// `text` without its angle brackets as an absolute path: `/a/b` or `/a/b.prop`; `../b`, `b` and
/// `.prop` are relative to the prim `owner`. Nothing if it is malformed or climbs above the root.
/// Variant selections, `{v=x}`, are not allowed.
std::optional<std::string> absoluteUsdPath(std::string_view text, std::string_view owner);

/// Whether an absolute path names a property.
bool isUsdPropertyPath(std::string_view path);
/// `/a/b` of `/a/b.prop`.
std::string_view usdPrimPart(std::string_view path);
/// `prop` of `/a/b.prop`; empty for a prim path.
std::string_view usdPropertyPart(std::string_view path);
/// `/a` of `/a/b`; `/` of `/a` and of `/`.
std::string_view usdParentPath(std::string_view path);
std::string usdChildPath(std::string_view parent, std::string_view name);
/// Whether a prim is another one or below it. \param above not the root
bool isUsdPathWithin(std::string_view path, std::string_view above);
/// The path of a prim within `from`, were it within `to`.
std::string movedUsdPath(std::string_view path, std::string_view from, std::string_view to);

} // namespace penumbra
