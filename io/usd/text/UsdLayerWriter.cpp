#include "io/usd/text/UsdLayerWriter.h"

#include "io/usd/text/UsdTextOutput.h"

#include <algorithm>
#include <string_view>

namespace penumbra {

namespace {

bool hasMetadata(const UsdDictionary& metadata) {
    return !std::all_of(metadata.begin(), metadata.end(), isUsdReorder);
}

class LayerWriter {
public:
    std::string write(const UsdLayer& layer) {
        out_.text = "#usda 1.0\n";
        if (hasMetadata(layer.metadata) || !layer.subLayers.empty() || !layer.relocates.empty()) {
            out_.text += "(\n";
            ++out_.depth;
            out_.metadata(layer.metadata);
            subLayers(layer.subLayers);
            relocates(layer.relocates);
            --out_.depth;
            out_.text += ")\n";
        }
        reorders(layer.metadata);
        for (const UsdPrimSpec& spec : layer.prims) prim(spec);
        return std::move(out_.text);
    }

private:
    void reorders(const UsdDictionary& entries);
    void subLayers(const std::vector<UsdSubLayer>& subLayers);
    void relocates(const std::vector<UsdRelocate>& relocates);
    void offset(const UsdLayerOffset& offset, const UsdDictionary& customData);
    void reference(const UsdReference& reference);
    void path(const std::string& path) { out_.text.append("<").append(path).append(">"); }
    void quoted(const std::string& name) { out_.text += usdLiteral(name); }
    void arcs(const UsdArcs& arcs);
    template <class Item, class Write>
    void edits(std::string_view key, const UsdListEdits<Item>& edits, Write write,
               bool brackets = false);
    void prim(const UsdPrimSpec& spec);
    void variantSet(const UsdVariantSet& set);
    void primMetadata(const UsdPrimSpec& spec);
    void body(const UsdPrimSpec& spec);

    UsdTextOutput out_;
};

void LayerWriter::reorders(const UsdDictionary& entries) {
    for (const UsdNamedValue& entry : entries)
        if (isUsdReorder(entry)) {
            out_.line().append(entry.name).append(" = ");
            appendUsdText(out_.text, entry.value, out_.depth);
            out_.text += '\n';
        }
}

// `(offset = n; scale = n; customData = {...})`, as far as there is something to say.
void LayerWriter::offset(const UsdLayerOffset& offset, const UsdDictionary& customData) {
    const char* before = " (";
    const auto add = [&](const char* key, const UsdValue& value) {
        out_.text.append(before).append(key).append(" = ");
        appendUsdText(out_.text, value, out_.depth);
        before = "; ";
    };
    const auto number = [](double value) {
        return UsdValue{{UsdKind::float64}, std::vector<double>{value}};
    };
    if (offset.offset != 0) add("offset", number(offset.offset));
    if (offset.scale != 1) add("scale", number(offset.scale));
    if (!customData.empty()) add("customData", UsdValue{{UsdKind::dictionary}, customData});
    if (*before == ';') out_.text += ')';
}

void LayerWriter::subLayers(const std::vector<UsdSubLayer>& subLayers) {
    if (subLayers.empty()) return;
    out_.line() += "subLayers = [\n";
    ++out_.depth;
    for (const UsdSubLayer& layer : subLayers) {
        out_.line() += usdAssetLiteral(layer.asset);
        offset(layer.offset, {});
        out_.text += ",\n";
    }
    --out_.depth;
    out_.line() += "]\n";
}

void LayerWriter::relocates(const std::vector<UsdRelocate>& relocates) {
    if (relocates.empty()) return;
    out_.line() += "relocates = {\n";
    for (const UsdRelocate& relocate : relocates) {
        out_.line() += "    ";
        path(relocate.source);
        out_.text += ": ";
        path(relocate.target);
        out_.text += ",\n";
    }
    out_.line() += "}\n";
}

void LayerWriter::reference(const UsdReference& reference) {
    if (!reference.asset.empty()) out_.text += usdAssetLiteral(reference.asset);
    if (!reference.path.empty() || reference.asset.empty()) path(reference.path);
    offset(reference.offset, reference.customData);
}

template <class Item, class Write>
void LayerWriter::edits(std::string_view key, const UsdListEdits<Item>& edits, Write write,
                        bool brackets) {
    for (const UsdListEdit<Item>& edit : edits) {
        out_.line().append(usdPrefix(edit.op)).append(key).append(" = ");
        out_.list(edit.items, brackets, write);
        out_.text += '\n';
    }
}

void LayerWriter::arcs(const UsdArcs& arcs) {
    const auto name = [&](const std::string& item) { quoted(item); };
    const auto target = [&](const std::string& item) { path(item); };
    const auto file = [&](const UsdReference& item) { reference(item); };
    edits("apiSchemas", arcs.apiSchemas, name, true);
    edits("inherits", arcs.inherits, target);
    edits("payload", arcs.payloads, file);
    edits("references", arcs.references, file);
    edits("specializes", arcs.specializes, target);
    if (!arcs.variants.empty()) {
        out_.line() += "variants = ";
        appendUsdText(out_.text, arcs.variants, out_.depth);
        out_.text += '\n';
    }
    edits("variantSets", arcs.variantSetNames, name);
}

void LayerWriter::primMetadata(const UsdPrimSpec& spec) {
    const std::size_t before = out_.text.size();
    out_.text += " (\n";
    const std::size_t begun = out_.text.size();
    ++out_.depth;
    out_.metadata(spec.metadata);
    if (spec.arcs) arcs(*spec.arcs);
    --out_.depth;
    if (out_.text.size() == begun)
        out_.text.resize(before);
    else
        out_.line() += ')';
}

// Layers are at most 1024 prims deep (UsdLayerLimits), and so is this recursion.
void LayerWriter::prim(const UsdPrimSpec& spec) {
    if (!out_.text.ends_with("{\n")) out_.text += '\n';
    out_.line() += spec.specifier == UsdSpecifier::def    ? "def "
                   : spec.specifier == UsdSpecifier::over ? "over "
                                                          : "class ";
    if (!spec.typeName.empty()) out_.text += spec.typeName + " ";
    quoted(spec.name);
    primMetadata(spec);
    out_.text += '\n';
    out_.line() += "{\n";
    body(spec);
    out_.line() += "}\n";
}

void LayerWriter::body(const UsdPrimSpec& spec) {
    ++out_.depth;
    for (const UsdProperty& property : spec.properties) writeUsdProperty(out_, property);
    reorders(spec.metadata);
    for (const UsdVariantSet& set : spec.variantSets) variantSet(set);
    for (const UsdPrimSpec& child : spec.children) prim(child);
    --out_.depth;
}

void LayerWriter::variantSet(const UsdVariantSet& set) {
    if (set.variants.empty()) return; // text can't say it
    out_.line() += "variantSet " + usdLiteral(set.name) + " = {\n";
    ++out_.depth;
    for (const UsdPrimSpec& variant : set.variants) {
        out_.line() += usdLiteral(variant.name);
        primMetadata(variant);
        out_.text += " {\n";
        body(variant);
        out_.line() += "}\n";
    }
    --out_.depth;
    out_.line() += "}\n";
}

} // namespace

std::string usdLayerText(const UsdLayer& layer) {
    return LayerWriter().write(layer);
}

} // namespace penumbra
