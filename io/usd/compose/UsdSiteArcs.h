// What the layers of one stack together say about the arcs of one prim.
#pragma once

#include "io/usd/compose/UsdCompositionErrors.h"
#include "io/usd/compose/UsdLayerStack.h"

#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// A reference or a payload, ready to be followed.
struct UsdSiteReference {
    std::string key;       ///< those with one key are the same
    std::string file;      ///< empty: this layer stack itself
    std::string asset;     ///< as it was written
    std::string path;      ///< of the prim; empty: the default prim
    UsdLayerOffset offset; ///< its own, below that of the layer that has it
    double timeCodes = 24; ///< a second of that layer
    SourceLocation where;
};

enum class UsdReferenceKind : std::uint8_t { reference, payload };
enum class UsdClassKind : std::uint8_t { inherit, specialize };

/// In the order of strength. Errors of expressions and offsets are reported.
std::vector<UsdSiteReference> referencesAt(const UsdLayerStack& stack, UsdSitePath path,
                                           UsdReferenceKind kind, UsdCompositionErrors& errors);
/// Paths of the classes, in the order of strength. Those that are none are reported.
std::vector<UsdSitePath> classesAt(const UsdLayerStack& stack, UsdSitePath path, UsdClassKind kind,
                                   UsdCompositionErrors& errors);
/// Names of the variant sets.
std::vector<std::string> variantSetsAt(const UsdLayerStack& stack, UsdSitePath path);
/// The strongest choice for a set that is written here; empty text chooses no variant.
std::optional<std::string> variantSelectionAt(const UsdLayerStack& stack, UsdSitePath path,
                                              const std::string& set, UsdCompositionErrors& errors);
/// Where the strongest layer says something about arcs here, or about the prim.
SourceLocation locationAt(const UsdLayerStack& stack, UsdSitePath path);
/// A key of the prim's metadata by its strongest opinion, or null.
const UsdValue* metadataAt(const UsdLayerStack& stack, UsdSitePath path, std::string_view key);

} // namespace penumbra
