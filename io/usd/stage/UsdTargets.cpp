#include "io/usd/stage/UsdTargets.h"

#include "io/usd/layer/UsdListOps.h"
#include "io/usd/layer/UsdPath.h"

#include <unordered_set>

namespace penumbra {

namespace {

// As the stage names it; empty: it is no part of what the arc brought.
std::string mapped(const UsdMapping* toStage, const std::string& target) {
    if (!toStage || toStage->isIdentity()) return target;
    if (toStage->pairs().empty()) return {};
    const UsdSitePath root = toStage->pairs().front().source.root();
    const UsdSitePath prim = root.fromText(usdPrimPart(target));
    const UsdSitePath image = prim ? toStage->map(prim) : UsdSitePath();
    if (!image) return {};
    const std::string_view property = usdPropertyPart(target);
    std::string text = image.text();
    if (!property.empty()) text.append(1, '.').append(property);
    return text;
}

} // namespace

UsdComposedTargets
composeTargets(const std::vector<UsdTargetOpinion>& opinions,
               const std::function<bool(std::size_t, const std::string&)>& allowed) {
    UsdComposedTargets result;
    std::unordered_set<std::string> deleted;
    for (std::size_t i = opinions.size(); i-- > 0;) { // from the weakest
        UsdListEdits<std::string> edits;
        for (const auto& edit : opinions[i].property->targets) {
            const bool removes = edit.op == UsdListOp::remove || edit.op == UsdListOp::reorder;
            if (edit.op == UsdListOp::explicitly) result.unmapped.clear();
            auto& made = edits.emplace_back();
            made.op = edit.op;
            for (const std::string& target : edit.items) {
                std::string image = mapped(opinions[i].toStage, target);
                const bool good = !image.empty() && (removes || !allowed || allowed(i, image));
                if (good)
                    made.items.push_back(std::move(image));
                else if (!removes)
                    result.unmapped.emplace_back(i, target);
            }
            if (edit.op == UsdListOp::remove)
                for (const std::string& target : made.items)
                    if (deleted.insert(target).second) result.deleted.push_back(target);
        }
        applyUsdListEdits(edits, result.paths);
    }
    return result;
}

} // namespace penumbra
