// The composed scene: what all layers together say about each prim.
#pragma once

#include "io/usd/stage/UsdComposition.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace penumbra {

/// One layer's opinion about one prim.
struct UsdOpinion {
    const UsdPrimSpec* spec = nullptr;
    const UsdLayer* layer = nullptr;
    UsdLayerOffset offset; ///< the layer's times to the stage's
    UsdMappingPtr toStage; ///< the layer's paths to the stage's; null: they are the same
};

/// A prim of the stage. Inactive prims are not on the stage at all.
struct UsdPrim {
    std::string name;
    std::string path;
    std::string typeName;
    UsdSpecifier specifier = UsdSpecifier::def;
    bool defined = true;   ///< it and all its ancestors are more than overs
    bool abstract = false; ///< it or an ancestor is a class: never part of the picture
    /// `instanceable`, and brought by an arc: opinions about what is below come from there alone.
    bool instance = false;
    std::uint32_t parent = 0;
    std::vector<std::uint32_t> children; ///< indices into UsdStage::prims(), in order
    std::vector<UsdOpinion> opinions;    ///< strongest first; the root has none

    /// Where the strongest opinion is.
    SourceLocation location() const;
};

/// A point in time: a time code, or nothing for the defaults alone.
using UsdTime = std::optional<double>;

/// The value of an attribute at a time: found in a layer, or interpolated. False if there is none.
class UsdResolved {
public:
    UsdResolved() = default;
    explicit UsdResolved(const UsdValue* stored) : stored_(stored) {}
    explicit UsdResolved(UsdValue made) : made_(std::move(made)) {}
    explicit operator bool() const { return stored_ || !made_.empty(); }
    const UsdValue& operator*() const { return stored_ ? *stored_ : made_; }
    const UsdValue* operator->() const { return &**this; }
    /// As it lies in a layer; null if it was interpolated.
    const UsdValue* stored() const { return stored_; }

private:
    const UsdValue* stored_ = nullptr; // lives in a layer
    UsdValue made_;
};

/// Time samples as one layer has them.
struct UsdSamples {
    const UsdProperty* property = nullptr; ///< null: none
    UsdLayerOffset offset;                 ///< the layer's times to the stage's
};

/// The composed scene: a root layer and all that it brings by sublayers, inherits, variants,
/// relocates, references, payloads and specializes. All payloads are loaded; a variant set
/// `standin` that nobody chooses for has its variant `render`. What can't be composed is warned of
/// and left out.
class UsdStage {
public:
    /// Throws SceneFileError for faults of the root layer; those of other layers are warned of.
    /// \param assets finds and reads layers; needed here only
    static UsdStage open(const std::filesystem::path& root, const UsdComposeLimits& limits = {},
                         const UsdAssets& assets = UsdAssets());

    /// All prims; [0] is the root "/". A parent comes before its children.
    const std::vector<UsdPrim>& prims() const { return prims_; }
    const UsdPrim* find(std::string_view path) const;
    const UsdLayer& rootLayer() const { return composition_->rootStack().rootLayer(); }
    /// The files of all layers, the root layer's first; then those that could not be understood. A
    /// package may be there several times.
    const std::vector<std::filesystem::path>& files() const { return files_; }
    Diagnostics& diagnostics() { return composition_->diagnostics(); }

    // The strongest opinions on one prim. ------------------------------------------------------

    /// Value of an attribute. Within a layer time samples beat the default, unless `time` is empty:
    /// then only defaults count, or, where there is none at all, the earliest sample. Numbers are
    /// interpolated linearly (quaternions along the great circle), everything else is held; beyond
    /// the ends the last sample holds. A block (`None`) is no value.
    static UsdResolved value(const UsdPrim& prim, std::string_view attribute, UsdTime time);
    /// The samples that decide the value of an attribute at all time codes.
    static UsdSamples samples(const UsdPrim& prim, std::string_view attribute);
    /// Whether some layer's samples make it change with time.
    static bool animated(const UsdPrim& prim, std::string_view attribute);
    /// The strongest declaration of a property, or null.
    static const UsdProperty* property(const UsdPrim& prim, std::string_view name);
    /// Composed targets of a relationship, or sources of a connected attribute, as paths of the
    /// stage. What lies outside of the prims that an arc brought is left out.
    static std::vector<std::string> targets(const UsdPrim& prim, std::string_view property);
    /// Applied API schemas; nothing if no layer says a word of them.
    static std::optional<std::vector<std::string>> apiSchemas(const UsdPrim& prim);
    static bool hasApi(const UsdPrim& prim, std::string_view schema);
    /// Metadata of a property, e.g. its interpolation; null if not authored.
    static const UsdValue* metadata(const UsdPrim& prim, std::string_view property,
                                    std::string_view key);
    /// Where a property was written, or else its prim.
    static SourceLocation location(const UsdPrim& prim, std::string_view property);

private:
    UsdStage() = default;

    std::unique_ptr<UsdComposition> composition_; // what opinions point to
    std::vector<std::filesystem::path> files_;
    std::vector<UsdPrim> prims_;
    std::unordered_map<std::string, std::uint32_t> indexOf_;

    friend class UsdStageBuilder;
};

/// Calls `take(property, opinion)` with what each layer says of a property, strongest first, until
/// it returns true. An attribute that a stronger layer has as a relationship is left out, and the
/// other way round.
template <class Take>
void eachUsdDeclaration(const UsdPrim& prim, std::string_view name, Take take) {
    const UsdProperty* strongest = nullptr;
    for (const UsdOpinion& opinion : prim.opinions) {
        const UsdProperty* found = opinion.spec->property(name);
        if (!found) continue;
        if (!strongest) strongest = found;
        if (found->relationship == strongest->relationship && take(*found, opinion)) return;
    }
}

} // namespace penumbra
