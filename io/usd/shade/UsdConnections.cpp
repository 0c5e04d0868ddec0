#include "io/usd/shade/UsdConnections.h"

#include "io/usd/layer/UsdPath.h"

namespace penumbra {

UsdSource usdSourceOf(const UsdStage& stage, const UsdPrim& prim, const std::string& attribute) {
    using Kind = UsdSource::Kind;
    UsdSource at{Kind::value, &prim, attribute};
    for (int i = 0; i < kMostConnections; ++i) {
        const auto sources = UsdStage::targets(*at.prim, at.attribute);
        if (sources.empty()) return at;
        const UsdPrim* const source = stage.find(usdPrimPart(sources.front()));
        if (!source) return {Kind::missing, at.prim, at.attribute, sources.front()};
        at.prim = source;
        at.attribute = usdPropertyPart(sources.front());
        if (source->typeName == "Shader" && at.attribute.starts_with("outputs:"))
            return {Kind::computed, at.prim, at.attribute};
    }
    return {Kind::circle, &prim, attribute};
}

} // namespace penumbra
