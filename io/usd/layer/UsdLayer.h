// One USD file as it was written: the tree of its opinions, before any composition.
#pragma once

#include "io/usd/layer/UsdDiagnostic.h"
#include "io/usd/layer/UsdScanner.h"
#include "io/usd/layer/UsdValue.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

/// How a statement edits a list that weaker opinions have begun.
enum class UsdListOp : std::uint8_t { explicitly, add, prepend, append, remove, reorder };

/// The opinions of one prim or property about a list, at most one of each kind; an explicit one
/// stands alone. Items are strings (paths, tokens) or references.
template <class Item>
struct UsdListEdit {
    UsdListOp op = UsdListOp::explicitly;
    std::vector<Item> items;
};
template <class Item>
using UsdListEdits = std::vector<UsdListEdit<Item>>;

/// Time of a layer below to the time of the layer above: outer = inner * scale + offset.
struct UsdLayerOffset {
    double offset = 0;
    double scale = 1;
};

struct UsdSubLayer {
    std::string asset;
    UsdLayerOffset offset;
    UsdPosition where;
};

/// An entry of a layer's `relocates`: the prim that arcs bring to `source` is at `target` instead.
struct UsdRelocate {
    std::string source; ///< absolute prim path
    std::string target; ///< the same; empty: the prim is removed
    UsdPosition where;
};

/// A target of `references` or `payload`.
struct UsdReference {
    std::string asset; ///< empty: this layer stack itself
    std::string path;  ///< absolute prim path; empty: the layer's defaultPrim
    UsdLayerOffset offset;
    UsdDictionary customData;
    UsdPosition where;
};

struct UsdTimeSample {
    double time = 0;
    UsdValue value;
};

/// An attribute or a relationship as one layer has it. Separate statements about one name are
/// merged.
struct UsdProperty {
    std::string name;
    std::string typeName; ///< without brackets; empty for a relationship
    UsdType type;
    bool relationship = false;
    bool custom = false;
    bool uniform = false; ///< attribute declared `uniform` or `config`
    bool varying = false; ///< relationship declared `varying`
    UsdPosition where;
    UsdValue value;                     ///< the default; empty if not authored
    std::vector<UsdTimeSample> samples; ///< sorted by time, times differ
    bool hasSamples = false;            ///< also if the braces were empty
    UsdListEdits<std::string> targets;  ///< connections or targets, absolute paths
    UsdDictionary metadata;
};

enum class UsdSpecifier : std::uint8_t { def, over, classes };

/// Composition arcs and other list-edited metadata of a prim. Most prims have none.
struct UsdArcs {
    UsdListEdits<UsdReference> references, payloads;
    UsdListEdits<std::string> inherits, specializes, variantSetNames, apiSchemas;
    UsdDictionary variants; ///< selections, set name to a string
    UsdPosition where;
};

struct UsdVariantSet;

/// A prim as one layer has it. The body of a variant is one too, without a name.
struct UsdPrimSpec {
    UsdSpecifier specifier = UsdSpecifier::def;
    std::string typeName;
    std::string name;
    UsdPosition where;
    UsdDictionary metadata;
    std::unique_ptr<UsdArcs> arcs; ///< may be null
    std::vector<UsdProperty> properties;
    std::vector<UsdPrimSpec> children;
    std::vector<UsdVariantSet> variantSets;

    const UsdProperty* property(std::string_view propertyName) const;
};

struct UsdVariantSet {
    std::string name;
    std::vector<UsdPrimSpec> variants; ///< UsdPrimSpec::name is the variant's
};

/// A layer: one file.
struct UsdLayer {
    std::string file; ///< as errors name it
    UsdDictionary metadata;
    std::vector<UsdSubLayer> subLayers;
    std::vector<UsdRelocate> relocates;
    std::vector<UsdPrimSpec> prims;
    std::vector<Diagnostic> diagnostics;

    SourceLocation location(UsdPosition p) const { return {file, p.line, p.column}; }
};

struct UsdLayerLimits {
    std::uintmax_t fileBytes = std::uintmax_t(2) << 30;
    std::size_t primDepth = 1024;
    std::size_t prims = 10'000'000;
};

/// Reads a layer from text. `file` is the name that errors and warnings carry. Throws
/// SceneFileError.
///
/// The parser is written by hand rather than with a parser library: prims are kept on a stack of
/// its own, so nesting costs heap, not stack; every other recursion has a stated limit; arrays of
/// numbers go from the text into their flat vector in one pass; and an error is thrown where it is
/// seen, with its line and column.
UsdLayer parseUsdLayer(const std::string& text, const std::string& file,
                       const UsdLayerLimits& limits = {});

/// Reads a layer from a text file. Throws SceneFileError, also for what isn't USD text: folders,
/// missing and empty files, binary USD and packages (UsdFiles reads these).
UsdLayer readUsdLayer(const std::filesystem::path& file, const UsdLayerLimits& limits = {});

} // namespace penumbra
