// Metadata: the parentheses after a layer's header, a prim's name or a property.
#pragma once

#include "io/usd/layer/UsdLayer.h"

#include <optional>

namespace penumbra {

/// Each reads a whole block; the cursor stands at its '('. Keys that OpenUSD knows are checked for
/// their type; others are kept as text. A bare string is stored under `comment`.
void parseLayerMetadata(UsdScanner& scanner, UsdLayer& layer);
/// \param path of the prim: inherits and specializes may be relative to it
void parsePrimMetadata(UsdScanner& scanner, UsdPrimSpec& prim, const std::string& path);
void parsePropertyMetadata(UsdScanner& scanner, UsdDictionary& metadata);

/// The type that OpenUSD prescribes for a key of metadata; kind unknown if it prescribes none.
UsdType usdMetadataType(std::string_view key);

/// Whether a prim's metadata of that name are arcs, or what composes like one.
bool isUsdArcKey(std::string_view key);

/// `prepend`, `add`, ... as list operation; nothing for any other word.
std::optional<UsdListOp> usdListOpNamed(std::string_view word);

/// Adds an edit: an explicit one replaces all others, another kind replaces an explicit one and one
/// of its own kind.
template <class Item>
void addListEdit(UsdListEdits<Item>& edits, UsdListOp op, std::vector<Item> items) {
    std::erase_if(edits, [op](const UsdListEdit<Item>& e) {
        return op == UsdListOp::explicitly || e.op == UsdListOp::explicitly || e.op == op;
    });
    edits.push_back({op, std::move(items)});
}

/// Reads `<path>` and makes it absolute; fails if it is malformed.
std::string parseUsdPath(UsdScanner& scanner, const std::string& owner);
/// Paths of a relationship or connection: None, one, or a bracketed list without repeats.
std::vector<std::string> parseUsdTargets(UsdScanner& scanner, const std::string& owner);

} // namespace penumbra
