#include "io/usd/layer/UsdStage.h"

#include "io/usd/layer/UsdListOps.h"
#include "io/usd/layer/UsdPath.h"

#include <algorithm>

namespace penumbra {

SourceLocation UsdPrim::location() const {
    return opinions.empty() ? SourceLocation{}
                            : opinions.front().layer->location(opinions.front().spec->where);
}

namespace {

bool isFalse(const UsdValue* value) {
    const auto numbers = value ? value->numbers() : std::vector<double>{};
    return numbers.size() == 1 && numbers[0] == 0;
}

// The strongest opinion about a prim's own metadata.
const UsdValue* strongestMetadata(const std::vector<UsdOpinion>& opinions, std::string_view key) {
    for (const UsdOpinion& opinion : opinions)
        if (const UsdValue* value = find(opinion.spec->metadata, key)) return value;
    return nullptr;
}

} // namespace

UsdStage UsdStage::open(const std::filesystem::path& root, const UsdLayerLimits& limits,
                        const UsdAssets& assets) {
    UsdStage stage;
    stage.layers_ = readUsdLayerStack(root, assets, limits, stage.diagnostics_, &stage.unread_);
    for (const UsdStackedLayer& stacked : stage.layers_)
        stage.files_.emplace_back(assets.fileOf(stacked.layer->file));
    stage.compose();
    return stage;
}

std::vector<std::filesystem::path> UsdStage::files() const {
    std::vector<std::filesystem::path> files = files_;
    files.insert(files.end(), unread_.begin(), unread_.end());
    return files;
}

const UsdPrim* UsdStage::find(std::string_view path) const {
    const auto found = indexOf_.find(std::string(path));
    return found == indexOf_.end() ? nullptr : &prims_[found->second];
}

// Breadth first: the list itself is the queue.
void UsdStage::compose() {
    UsdPrim root;
    root.path = "/";
    prims_.push_back(std::move(root));
    indexOf_["/"] = 0;
    for (std::uint32_t i = 0; i < prims_.size(); ++i) addChildren(i);
}

// Children in the order of the weakest layer first, as OpenUSD has it; what stronger layers add
// follows.
void UsdStage::addChildren(std::uint32_t parent) {
    std::vector<std::pair<std::string, std::vector<UsdOpinion>>> found;
    std::unordered_map<std::string_view, std::size_t> indexOf;
    const auto collect = [&](const std::vector<UsdPrimSpec>& specs, const UsdLayer* layer,
                             UsdLayerOffset offset) {
        for (const UsdPrimSpec& spec : specs) {
            const auto [place, isNew] = indexOf.try_emplace(spec.name, found.size());
            if (isNew) found.push_back({spec.name, {}});
            found[place->second].second.push_back({&spec, layer, offset});
        }
    };
    if (parent == 0) {
        for (std::size_t i = layers_.size(); i-- > 0;)
            collect(layers_[i].layer->prims, layers_[i].layer.get(), layers_[i].offset);
    } else {
        const auto opinions = prims_[parent].opinions;
        for (std::size_t i = opinions.size(); i-- > 0;)
            collect(opinions[i].spec->children, opinions[i].layer, opinions[i].offset);
    }
    for (auto& [name, opinions] : found) {
        std::reverse(opinions.begin(), opinions.end()); // strongest first
        addPrim(parent, std::move(name), std::move(opinions));
    }
}

void UsdStage::addPrim(std::uint32_t parent, std::string name, std::vector<UsdOpinion> opinions) {
    if (isFalse(strongestMetadata(opinions, "active"))) return;
    UsdPrim prim;
    prim.path = usdChildPath(prims_[parent].path, name);
    prim.name = std::move(name);
    prim.parent = parent;
    prim.specifier = UsdSpecifier::over;
    for (const UsdOpinion& opinion : opinions) {
        if (prim.specifier == UsdSpecifier::over) prim.specifier = opinion.spec->specifier;
        if (prim.typeName.empty()) prim.typeName = opinion.spec->typeName;
        warnOfArcs(opinion);
    }
    prim.defined = prims_[parent].defined && prim.specifier != UsdSpecifier::over;
    prim.abstract = prims_[parent].abstract || prim.specifier == UsdSpecifier::classes;
    prim.opinions = std::move(opinions);
    const auto index = std::uint32_t(prims_.size());
    indexOf_[prim.path] = index;
    prims_[parent].children.push_back(index);
    prims_.push_back(std::move(prim));
}

void UsdStage::warnOfArcs(const UsdOpinion& opinion) {
    const UsdPrimSpec& spec = *opinion.spec;
    const auto warn = [&](const char* what, UsdPosition where) {
        diagnostics_.warn(opinion.layer->location(where), std::string(what) + " not composed yet");
    };
    const auto hasItems = [](const auto& edits) {
        return std::any_of(edits.begin(), edits.end(), [](const auto& e) {
            return e.op != UsdListOp::remove && !e.items.empty();
        });
    };
    if (!spec.variantSets.empty()) warn("variants", spec.where);
    if (!spec.arcs) return;
    if (hasItems(spec.arcs->references)) warn("references", spec.arcs->where);
    if (hasItems(spec.arcs->payloads)) warn("payloads", spec.arcs->where);
    if (hasItems(spec.arcs->inherits)) warn("inherits", spec.arcs->where);
    if (hasItems(spec.arcs->specializes)) warn("specializes", spec.arcs->where);
}

const UsdProperty* UsdStage::property(const UsdPrim& prim, std::string_view name) {
    for (const UsdOpinion& opinion : prim.opinions)
        if (const UsdProperty* found = opinion.spec->property(name)) return found;
    return nullptr;
}

std::vector<std::string> UsdStage::targets(const UsdPrim& prim, std::string_view property) {
    std::vector<std::string> list;
    for (std::size_t i = prim.opinions.size(); i-- > 0;) // from the weakest
        if (const UsdProperty* found = prim.opinions[i].spec->property(property))
            applyUsdListEdits(found->targets, list);
    return list;
}

bool UsdStage::hasApi(const UsdPrim& prim, std::string_view schema) {
    std::vector<std::string> schemas;
    for (std::size_t i = prim.opinions.size(); i-- > 0;) // from the weakest
        if (const auto& arcs = prim.opinions[i].spec->arcs)
            applyUsdListEdits(arcs->apiSchemas, schemas);
    return std::find(schemas.begin(), schemas.end(), schema) != schemas.end();
}

const UsdValue* UsdStage::metadata(const UsdPrim& prim, std::string_view property,
                                   std::string_view key) {
    for (const UsdOpinion& opinion : prim.opinions)
        if (const UsdProperty* found = opinion.spec->property(property))
            if (const UsdValue* value = penumbra::find(found->metadata, key)) return value;
    return nullptr;
}

SourceLocation UsdStage::location(const UsdPrim& prim, std::string_view property) {
    for (const UsdOpinion& opinion : prim.opinions)
        if (const UsdProperty* found = opinion.spec->property(property))
            return opinion.layer->location(found->where);
    return prim.location();
}

} // namespace penumbra
