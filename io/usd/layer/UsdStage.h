// The composed scene: what all layers together say about each prim.
#pragma once

#include "io/usd/layer/UsdLayerStack.h"

#include <cstdint>
#include <filesystem>
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
};

/// A prim of the stage. Inactive prims are not on the stage at all.
struct UsdPrim {
    std::string name;
    std::string path;
    std::string typeName;
    UsdSpecifier specifier = UsdSpecifier::def;
    bool defined = true;   ///< it and all its ancestors are more than overs
    bool abstract = false; ///< it or an ancestor is a class: never part of the picture
    std::uint32_t parent = 0;
    std::vector<std::uint32_t> children; ///< indices into UsdStage::prims(), in order
    std::vector<UsdOpinion> opinions;    ///< strongest first, at least one (the root has none)

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

private:
    const UsdValue* stored_ = nullptr; // lives in a layer
    UsdValue made_;
};

/// The composed scene, from a root layer and its sublayers (strength: local opinions only).
/// References, payloads, inherits, specializes and variants are not composed yet: each is warned
/// of.
class UsdStage {
public:
    /// Throws SceneFileError for faults of the root layer; sublayers' faults are warned of.
    /// \param assets finds and reads layers; needed here only
    static UsdStage open(const std::filesystem::path& root, const UsdLayerLimits& limits = {},
                         const UsdAssets& assets = UsdAssets());

    /// All prims; [0] is the root "/". A parent comes before its children.
    const std::vector<UsdPrim>& prims() const { return prims_; }
    const UsdPrim* find(std::string_view path) const;
    const UsdLayer& rootLayer() const { return *layers_.front().layer; }
    /// The files of all layers, the root layer's first; then those that could not be understood. A
    /// package may be there several times.
    std::vector<std::filesystem::path> files() const;
    Diagnostics& diagnostics() { return diagnostics_; }

    // The strongest opinions on one prim. ------------------------------------------------------

    /// Value of an attribute. Within a layer time samples beat the default, unless `time` is empty:
    /// then only defaults count, or, where there is none at all, the earliest sample. Numbers are
    /// interpolated linearly (quaternions along the great circle), everything else is held; beyond
    /// the ends the last sample holds. A block (`None`) is no value.
    static UsdResolved value(const UsdPrim& prim, std::string_view attribute, UsdTime time);
    /// Whether some layer's samples make it change with time.
    static bool animated(const UsdPrim& prim, std::string_view attribute);
    /// The strongest declaration of a property, or null.
    static const UsdProperty* property(const UsdPrim& prim, std::string_view name);
    /// Composed targets of a relationship, or sources of a connected attribute.
    static std::vector<std::string> targets(const UsdPrim& prim, std::string_view property);
    static bool hasApi(const UsdPrim& prim, std::string_view schema);
    /// Metadata of a property, e.g. its interpolation; null if not authored.
    static const UsdValue* metadata(const UsdPrim& prim, std::string_view property,
                                    std::string_view key);
    /// Where a property was written, or else its prim.
    static SourceLocation location(const UsdPrim& prim, std::string_view property);

private:
    UsdStage() = default;
    void compose();
    void addChildren(std::uint32_t parent);
    void addPrim(std::uint32_t parent, std::string name, std::vector<UsdOpinion> opinions);
    void warnOfArcs(const UsdOpinion& opinion);

    std::vector<UsdStackedLayer> layers_;
    std::vector<std::filesystem::path> files_;
    std::vector<std::filesystem::path> unread_; ///< sublayers that are there but were left out
    std::vector<UsdPrim> prims_;
    std::unordered_map<std::string, std::uint32_t> indexOf_;
    Diagnostics diagnostics_;
};

} // namespace penumbra
