#include "io/usd/stage/UsdStageBuilder.h"

#include "io/usd/stage/UsdTargets.h"

#include <unordered_set>

namespace penumbra {

namespace {

bool isFalse(const UsdValue* value) {
    const auto numbers = value ? value->numbers() : std::vector<double>{};
    return numbers.size() == 1 && numbers[0] == 0;
}

// The strongest opinion about a prim's own metadata.
const UsdValue* strongestMetadata(const std::vector<UsdComposedSpec>& stack, std::string_view key) {
    for (const UsdComposedSpec& one : stack)
        if (const UsdValue* value = find(one.spec->metadata, key)) return value;
    return nullptr;
}

// A class that is inherited or specialized makes no class of what does so.
UsdSpecifier specifierOf(const UsdPrimIndex& index, const std::vector<UsdComposedSpec>& stack) {
    UsdSpecifier weak = UsdSpecifier::over;
    for (const UsdComposedSpec& one : stack) {
        if (one.spec->specifier == UsdSpecifier::over) continue;
        if (one.spec->specifier == UsdSpecifier::def) return UsdSpecifier::def;
        std::uint32_t node = one.node;
        while (node != kNoNode && !isClassArc(index[node].arc)) node = index[node].parent;
        if (node == kNoNode) return UsdSpecifier::classes;
        weak = UsdSpecifier::classes;
    }
    return weak;
}

std::vector<UsdOpinion> opinionsOf(UsdPrimIndex& index, const std::vector<UsdComposedSpec>& stack) {
    std::vector<UsdOpinion> opinions;
    opinions.reserve(stack.size());
    for (const UsdComposedSpec& one : stack) {
        const UsdMapping& mapping = index.toRoot(one.node);
        opinions.push_back({one.spec, one.layer->layer.get(),
                            after(mapping.offset(), one.layer->offset),
                            mapping.isIdentity() ? nullptr : index[one.node].toRoot});
    }
    return opinions;
}

} // namespace

// Breadth first: the list of prims itself is the queue.
void UsdStageBuilder::build() {
    UsdPrim root;
    root.path = "/";
    stage_.prims_.push_back(std::move(root));
    stage_.indexOf_["/"] = 0;
    indices_.push_back(composition_.root());
    for (std::uint32_t i = 0; i < stage_.prims_.size(); ++i) addChildren(i);
}

void UsdStageBuilder::addChildren(std::uint32_t parent) {
    const UsdPrimIndex index = std::move(indices_[parent]);
    indices_[parent] = {};
    if (index.path().levels() >= limits_.levels) {
        composition_.errors().report(stage_.prims_[parent].location(),
                                     "prims nested too deeply: those below this one are left out");
        return;
    }
    for (const std::string& name : childNames(index).names) {
        if (full_) return;
        addPrim(parent, composition_.child(index, name));
    }
}

bool UsdStageBuilder::mayAdd(std::size_t opinions) {
    opinions_ += opinions;
    if (stage_.prims_.size() < limits_.prims && opinions_ < limits_.opinions) return true;
    composition_.errors().report({stage_.rootLayer().file, 0, 0},
                                 "the composed scene is too large: it ends after " +
                                     std::to_string(stage_.prims_.size()) + " prims");
    full_ = true;
    return false;
}

void UsdStageBuilder::addPrim(std::uint32_t parent, UsdPrimIndex index) {
    auto& prims = stage_.prims_;
    const auto stack = primStack(index);
    if (isFalse(strongestMetadata(stack, "active"))) return;
    if (!mayAdd(stack.size())) return;
    UsdPrim prim;
    prim.path = index.path().text();
    prim.name = index.path().name();
    prim.parent = parent;
    prim.specifier = specifierOf(index, stack);
    for (const UsdComposedSpec& one : stack)
        if (prim.typeName.empty()) prim.typeName = one.spec->typeName;
    prim.defined = prims[parent].defined && prim.specifier != UsdSpecifier::over;
    prim.abstract = prims[parent].abstract || prim.specifier == UsdSpecifier::classes;
    prim.instance = !sharedNodes(index).empty();
    prim.opinions = opinionsOf(index, stack);
    checkTargets(prim);
    const auto number = std::uint32_t(prims.size());
    stage_.indexOf_[prim.path] = number;
    prims[parent].children.push_back(number);
    prims.push_back(std::move(prim));
    indices_.push_back(std::move(index));
}

// Only what comes through an arc can be wrong.
void UsdStageBuilder::checkTargets(const UsdPrim& prim) {
    std::unordered_set<std::string_view> seen;
    for (const UsdOpinion& opinion : prim.opinions)
        for (const UsdProperty& property : opinion.spec->properties) {
            if (!opinion.toStage || property.targets.empty()) continue;
            if (!seen.insert(property.name).second) continue;
            std::vector<UsdTargetOpinion> opinions;
            std::vector<const UsdLayer*> layers;
            eachUsdDeclaration(prim, property.name,
                               [&](const UsdProperty& found, const UsdOpinion& one) {
                                   opinions.push_back({&found, one.toStage.get()});
                                   layers.push_back(one.layer);
                                   return false;
                               });
            for (const auto& [i, target] : composeTargets(opinions).unmapped)
                composition_.errors().report(layers[i]->location(opinions[i].property->where),
                                             "target <" + target + "> of <" + prim.path + "." +
                                                 property.name +
                                                 "> is outside of what the arc brings");
        }
}

} // namespace penumbra
