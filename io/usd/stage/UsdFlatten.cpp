#include "io/usd/stage/UsdFlatten.h"

#include <algorithm>
#include <unordered_set>

namespace penumbra {

namespace {

/// Metadata that composition has used up, or that no longer holds.
bool isUsedUp(const std::string& name) {
    return name.starts_with("reorder ") || name == "instanceable" ||
           name == "expressionVariables" || name == "relocates";
}

/// Puts weaker entries beneath stronger ones; dictionaries are combined.
void addWeaker(UsdDictionary& entries, const UsdDictionary& weaker) {
    for (const UsdNamedValue& entry : weaker) {
        const auto found =
            std::find_if(entries.begin(), entries.end(), [&](const UsdNamedValue& stronger) {
                return stronger.name == entry.name;
            });
        if (found == entries.end())
            entries.push_back(entry);
        else if (auto* inner = std::get_if<UsdDictionary>(&found->value.data))
            if (const UsdDictionary* more = entry.value.dictionary()) addWeaker(*inner, *more);
    }
}

class StageFlattener {
public:
    StageFlattener(const UsdStage& stage, const UsdAssets& assets, std::filesystem::path output)
        : stage_(stage), assets_(assets), output_(std::move(output)) {}

    UsdLayer layer() const {
        UsdLayer layer;
        layer.file = output_.string();
        layer.metadata = ofLayer(stage_.rootLayer().metadata, stage_.rootLayer());
        // Parents come before their children: from the end, each takes children that are complete.
        const std::vector<UsdPrim>& prims = stage_.prims();
        std::vector<UsdPrimSpec> specs(prims.size());
        for (std::size_t i = prims.size(); i-- > 0;) {
            if (i > 0) specs[i] = prim(prims[i]);
            for (const std::uint32_t child : prims[i].children)
                specs[i].children.push_back(std::move(specs[child]));
        }
        layer.prims = std::move(specs.front().children);
        return layer;
    }

private:
    UsdPrimSpec prim(const UsdPrim& prim) const {
        UsdPrimSpec spec;
        spec.specifier = prim.specifier;
        spec.typeName = prim.typeName;
        spec.name = prim.name;
        for (const UsdOpinion& opinion : prim.opinions)
            addWeaker(spec.metadata, ofLayer(opinion.spec->metadata, *opinion.layer));
        if (auto schemas = UsdStage::apiSchemas(prim)) {
            spec.arcs = std::make_unique<UsdArcs>();
            spec.arcs->apiSchemas = {{UsdListOp::explicitly, std::move(*schemas)}};
        }
        for (const std::string& name : propertyNames(prim))
            spec.properties.push_back(property(prim, name));
        return spec;
    }

    /// In the order of the weakest layer, then of those over it.
    static std::vector<std::string> propertyNames(const UsdPrim& prim) {
        std::vector<std::string> names;
        std::unordered_set<std::string_view> seen;
        for (std::size_t i = prim.opinions.size(); i-- > 0;)
            for (const UsdProperty& property : prim.opinions[i].spec->properties)
                if (seen.insert(property.name).second) names.push_back(property.name);
        return names;
    }

    UsdProperty property(const UsdPrim& prim, const std::string& name) const {
        UsdProperty made;
        made.name = name;
        bool targets = false;
        const UsdProperty& strongest = *UsdStage::property(prim, name);
        made.relationship = strongest.relationship;
        made.uniform = strongest.uniform;
        made.varying = strongest.varying;
        made.custom = strongest.custom;
        eachUsdDeclaration(prim, name, [&](const UsdProperty& found, const UsdOpinion& opinion) {
            if (made.typeName.empty()) {
                made.typeName = found.typeName;
                made.type = found.type;
            }
            addValue(made, found, opinion);
            targets = targets || !found.targets.empty();
            addWeaker(made.metadata, ofLayer(found.metadata, *opinion.layer));
            return false;
        });
        if (targets) made.targets = {{UsdListOp::explicitly, UsdStage::targets(prim, name)}};
        return made;
    }

    /// Default and samples of a weaker opinion, where no stronger one hides them: samples are
    /// hidden by any value, a default by a default alone.
    void addValue(UsdProperty& made, const UsdProperty& found, const UsdOpinion& opinion) const {
        if (!found.samples.empty() && made.samples.empty() && made.value.empty()) {
            for (const UsdTimeSample& sample : found.samples)
                made.samples.push_back(
                    {sample.time * opinion.offset.scale + opinion.offset.offset,
                     ofLayer(sample.value, *opinion.layer, opinion.offset, found.typeName)});
            std::stable_sort(
                made.samples.begin(), made.samples.end(),
                [](const UsdTimeSample& a, const UsdTimeSample& b) { return a.time < b.time; });
            made.hasSamples = true;
        }
        if (made.value.empty() && !found.value.empty())
            made.value = ofLayer(found.value, *opinion.layer, opinion.offset, found.typeName);
    }

    /// The value as the flattened layer has it: times are the stage's.
    UsdValue ofLayer(UsdValue value, const UsdLayer& layer, const UsdLayerOffset& offset,
                     const std::string& typeName) const {
        if (typeName == "timecode")
            if (auto* times = std::get_if<std::vector<double>>(&value.data))
                for (double& time : *times) time = time * offset.scale + offset.offset;
        redirectAssets(value, layer);
        return value;
    }

    UsdDictionary ofLayer(UsdDictionary entries, const UsdLayer& layer) const {
        std::erase_if(entries, [](const UsdNamedValue& entry) { return isUsedUp(entry.name); });
        for (UsdNamedValue& entry : entries) redirectAssets(entry.value, layer);
        return entries;
    }

    void redirectAssets(UsdValue& value, const UsdLayer& layer) const {
        if (auto* entries = std::get_if<UsdDictionary>(&value.data))
            for (UsdNamedValue& entry : *entries) redirectAssets(entry.value, layer);
        if (value.type.kind != UsdKind::asset) return;
        if (auto* paths = std::get_if<std::vector<std::string>>(&value.data))
            for (std::string& path : *paths) path = redirected(path, layer);
    }

    /// Whole paths, addresses and expressions stay as they are.
    std::string redirected(const std::string& asset, const UsdLayer& layer) const {
        const bool stays = asset.empty() || asset.front() == '/' || asset.front() == '`' ||
                           asset.find("://") != std::string::npos;
        return stays ? asset : relativeAsset(assets_.resolve(layer.file, asset), output_);
    }

    const UsdStage& stage_;
    const UsdAssets& assets_;
    std::filesystem::path output_;
};

} // namespace

UsdLayer flattenUsdStage(const UsdStage& stage, const UsdAssets& assets,
                         const std::filesystem::path& output) {
    return StageFlattener(stage, assets, output).layer();
}

} // namespace penumbra
