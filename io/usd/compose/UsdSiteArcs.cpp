#include "io/usd/compose/UsdSiteArcs.h"

#include "io/usd/compose/UsdExpression.h"
#include "io/usd/compose/UsdLayerStacks.h"
#include "io/usd/layer/UsdListOps.h"
#include "io/usd/layer/UsdText.h"

namespace penumbra {

namespace {

// Calls `use` with each layer's spec, weakest first.
template <class Use>
void fromWeakest(const UsdLayerStack& stack, UsdSitePath path, Use use) {
    for (std::size_t i = stack.layers.size(); i-- > 0;)
        if (const UsdPrimSpec* spec = stack.layers[i].index->spec(path))
            use(stack.layers[i], *spec);
}

// Calls `use` with each layer's spec, strongest first, until it returns true.
template <class Use>
void fromStrongest(const UsdLayerStack& stack, UsdSitePath path, Use use) {
    for (const UsdStackedLayer& stacked : stack.layers)
        if (const UsdPrimSpec* spec = stacked.index->spec(path))
            if (use(stacked, *spec)) return;
}

// Empty: nothing to follow.
std::optional<UsdSiteReference> prepared(const UsdLayerStack& stack, const UsdStackedLayer& stacked,
                                         const UsdReference& written,
                                         UsdCompositionErrors& errors) {
    UsdSiteReference made;
    made.where = stacked.layer->location(written.where);
    const UsdEvaluated asset = evaluateUsdText(written.asset, stack.variables);
    if (!asset.error.empty()) {
        errors.report(made.where, "asset path '" + written.asset + "': " + asset.error);
        return std::nullopt;
    }
    if (asset.text.empty() && !written.asset.empty()) return std::nullopt;
    made.asset = asset.text;
    if (!asset.text.empty()) made.file = stack.assets->resolve(stacked.file, asset.text);
    made.path = written.path;
    UsdLayerOffset own = written.offset;
    if (!isValid(own)) {
        errors.report(made.where, "invalid layer offset ignored");
        own = {};
    }
    made.offset = after(stacked.offset, own);
    made.timeCodes = timeCodesPerSecond(*stacked.layer);
    made.key = std::filesystem::path(made.file).lexically_normal().string() + "\n" + made.path +
               "\n" + std::to_string(written.offset.offset) + "\n" +
               std::to_string(written.offset.scale);
    return made;
}

} // namespace

std::vector<UsdSiteReference> referencesAt(const UsdLayerStack& stack, UsdSitePath path,
                                           UsdReferenceKind kind, UsdCompositionErrors& errors) {
    std::vector<UsdSiteReference> list;
    fromWeakest(stack, path, [&](const UsdStackedLayer& stacked, const UsdPrimSpec& spec) {
        if (!spec.arcs) return;
        UsdListEdits<UsdSiteReference> edits;
        for (const auto& edit :
             kind == UsdReferenceKind::payload ? spec.arcs->payloads : spec.arcs->references) {
            auto& made = edits.emplace_back();
            made.op = edit.op;
            for (const UsdReference& written : edit.items)
                if (auto one = prepared(stack, stacked, written, errors))
                    made.items.push_back(*std::move(one));
        }
        applyUsdListEdits(edits, list, [](const UsdSiteReference& one) { return one.key; });
    });
    return list;
}

std::vector<UsdSitePath> classesAt(const UsdLayerStack& stack, UsdSitePath path, UsdClassKind kind,
                                   UsdCompositionErrors& errors) {
    std::vector<std::string> list;
    fromWeakest(stack, path, [&](const UsdStackedLayer&, const UsdPrimSpec& spec) {
        if (!spec.arcs) return;
        applyUsdListEdits(
            kind == UsdClassKind::inherit ? spec.arcs->inherits : spec.arcs->specializes, list);
    });
    std::vector<UsdSitePath> classes;
    for (const std::string& text : list)
        if (const UsdSitePath found = path.fromText(text))
            classes.push_back(found);
        else
            errors.report(locationAt(stack, path), "class <" + printable(text) + "> of <" +
                                                       path.text() +
                                                       "> left out: not the path of a prim");
    return classes;
}

std::vector<std::string> variantSetsAt(const UsdLayerStack& stack, UsdSitePath path) {
    std::vector<std::string> list;
    fromWeakest(stack, path, [&](const UsdStackedLayer&, const UsdPrimSpec& spec) {
        if (spec.arcs) applyUsdListEdits(spec.arcs->variantSetNames, list);
    });
    return list;
}

std::optional<std::string> variantSelectionAt(const UsdLayerStack& stack, UsdSitePath path,
                                              const std::string& set,
                                              UsdCompositionErrors& errors) {
    std::optional<std::string> found;
    fromStrongest(stack, path, [&](const UsdStackedLayer& stacked, const UsdPrimSpec& spec) {
        const UsdValue* value = spec.arcs ? find(spec.arcs->variants, set) : nullptr;
        const std::string* text = value ? value->text() : nullptr;
        if (!text) return false;
        const UsdEvaluated choice = evaluateUsdText(*text, stack.variables);
        if (choice.error.empty())
            found = choice.text;
        else
            errors.report(stacked.layer->location(spec.where),
                          "selection of variant set '" + set + "': " + choice.error);
        return found.has_value();
    });
    return found;
}

SourceLocation locationAt(const UsdLayerStack& stack, UsdSitePath path) {
    SourceLocation where{stack.rootLayer().file, 0, 0};
    fromStrongest(stack, path, [&](const UsdStackedLayer& stacked, const UsdPrimSpec& spec) {
        where = stacked.layer->location(spec.where);
        return true;
    });
    return where;
}

const UsdValue* metadataAt(const UsdLayerStack& stack, UsdSitePath path, std::string_view key) {
    const UsdValue* value = nullptr;
    fromStrongest(stack, path, [&](const UsdStackedLayer&, const UsdPrimSpec& spec) {
        value = find(spec.metadata, key);
        return value != nullptr;
    });
    return value;
}

} // namespace penumbra
