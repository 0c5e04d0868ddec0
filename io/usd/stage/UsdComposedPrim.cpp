#include "io/usd/stage/UsdComposedPrim.h"

#include "io/usd/layer/UsdListOps.h"

#include <algorithm>
#include <set>
#include <unordered_set>

namespace penumbra {

namespace {

// Names in an order that grows from the weakest opinion to the strongest.
class NameList {
public:
    void add(const std::string& name) {
        if (present_.insert(name).second) names_.push_back(name);
    }

    // Applies what a stack relocates from below `path`, to it, or within it.
    void relocate(const UsdRelocates& relocates, UsdSitePath path) {
        for (const auto& [source, target] : relocates.sourcesBelow(path)) {
            prohibited_.insert(source.name());
            if (!present_.erase(source.name())) continue;
            const auto at = std::find(names_.begin(), names_.end(), source.name());
            const bool stays = target && target.parent() == path;
            if (stays && present_.insert(target.name()).second)
                *at = target.name();
            else
                names_.erase(at);
        }
        for (const auto& pair : relocates.targetsBelow(path)) add(pair.target.name());
    }

    void reorder(const UsdDictionary& metadata, std::string_view key) {
        const UsdValue* value = find(metadata, key);
        const auto* order = value ? value->as<std::string>() : nullptr;
        if (order)
            reorderUsdList(*order, names_,
                           [](const std::string& name) -> const std::string& { return name; });
    }

    UsdChildNames take() {
        std::erase_if(names_, [this](const std::string& n) { return prohibited_.contains(n); });
        return {std::move(names_), {prohibited_.begin(), prohibited_.end()}};
    }

private:
    std::vector<std::string> names_;
    std::unordered_set<std::string> present_;
    std::set<std::string> prohibited_;
};

void addNames(const UsdStackedLayer& stacked, UsdSitePath path, NameList& list) {
    const UsdPrimSpec* spec = path.isRoot() ? nullptr : stacked.index->spec(path);
    if (!path.isRoot() && !spec) return;
    for (const UsdPrimSpec& child : spec ? spec->children : stacked.layer->prims)
        list.add(child.name);
    if (spec)
        list.reorder(spec->metadata, "reorder nameChildren");
    else
        list.reorder(stacked.layer->metadata, "reorder rootPrims");
}

} // namespace

std::vector<UsdComposedSpec> primStack(const UsdPrimIndex& index) {
    std::vector<UsdComposedSpec> stack;
    for (const std::uint32_t node : index.strengthOrder()) {
        const UsdNode& n = index[node];
        if (!n.speaks() || !n.hasSpecs) continue;
        for (const UsdStackedLayer& stacked : n.stack->layers)
            if (const UsdPrimSpec* spec = stacked.index->spec(n.path))
                stack.push_back({spec, &stacked, node});
    }
    return stack;
}

UsdChildNames childNames(const UsdPrimIndex& index) {
    const std::vector<bool> shared = sharedNodes(index);
    NameList list;
    const auto order = index.strengthOrder();
    for (std::size_t i = order.size(); i-- > 0;) {
        const UsdNode& node = index[order[i]];
        if (node.cut || (!shared.empty() && !shared[order[i]])) continue;
        if (!node.stack->relocates.empty()) list.relocate(node.stack->relocates, node.path);
        if (!node.speaks() || !node.hasSpecs) continue;
        for (std::size_t layer = node.stack->layers.size(); layer-- > 0;)
            addNames(node.stack->layers[layer], node.path, list);
    }
    return list.take();
}

} // namespace penumbra
