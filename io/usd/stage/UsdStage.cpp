#include "io/usd/stage/UsdStage.h"

#include "io/usd/layer/UsdListOps.h"
#include "io/usd/stage/UsdStageBuilder.h"
#include "io/usd/stage/UsdTargets.h"

#include <algorithm>

namespace penumbra {

SourceLocation UsdPrim::location() const {
    return opinions.empty() ? SourceLocation{}
                            : opinions.front().layer->location(opinions.front().spec->where);
}

UsdStage UsdStage::open(const std::filesystem::path& root, const UsdComposeLimits& limits,
                        const UsdAssets& assets) {
    UsdStage stage;
    stage.composition_ = std::make_unique<UsdComposition>(root, limits, assets);
    UsdStageBuilder(stage, limits).build();
    stage.files_ = stage.composition_->files();
    return stage;
}

const UsdPrim* UsdStage::find(std::string_view path) const {
    const auto found = indexOf_.find(std::string(path));
    return found == indexOf_.end() ? nullptr : &prims_[found->second];
}

const UsdProperty* UsdStage::property(const UsdPrim& prim, std::string_view name) {
    for (const UsdOpinion& opinion : prim.opinions)
        if (const UsdProperty* found = opinion.spec->property(name)) return found;
    return nullptr;
}

std::vector<std::string> UsdStage::targets(const UsdPrim& prim, std::string_view property) {
    std::vector<UsdTargetOpinion> opinions;
    eachUsdDeclaration(prim, property, [&](const UsdProperty& found, const UsdOpinion& opinion) {
        opinions.push_back({&found, opinion.toStage.get()});
        return false;
    });
    if (opinions.empty()) return {};
    return composeTargets(opinions).paths;
}

std::optional<std::vector<std::string>> UsdStage::apiSchemas(const UsdPrim& prim) {
    std::optional<std::vector<std::string>> schemas;
    for (std::size_t i = prim.opinions.size(); i-- > 0;) { // from the weakest
        const auto& arcs = prim.opinions[i].spec->arcs;
        if (!arcs || arcs->apiSchemas.empty()) continue;
        if (!schemas) schemas.emplace();
        applyUsdListEdits(arcs->apiSchemas, *schemas);
    }
    return schemas;
}

bool UsdStage::hasApi(const UsdPrim& prim, std::string_view schema) {
    const auto schemas = apiSchemas(prim);
    return schemas && std::find(schemas->begin(), schemas->end(), schema) != schemas->end();
}

const UsdValue* UsdStage::metadata(const UsdPrim& prim, std::string_view property,
                                   std::string_view key) {
    const UsdValue* value = nullptr;
    eachUsdDeclaration(prim, property, [&](const UsdProperty& found, const UsdOpinion&) {
        value = penumbra::find(found.metadata, key);
        return value != nullptr;
    });
    return value;
}

SourceLocation UsdStage::location(const UsdPrim& prim, std::string_view property) {
    for (const UsdOpinion& opinion : prim.opinions)
        if (const UsdProperty* found = opinion.spec->property(property))
            return opinion.layer->location(found->where);
    return prim.location();
}

} // namespace penumbra
