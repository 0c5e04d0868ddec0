#include "tests/io/usd/crate/LayerDifference.h"

#include "io/usd/text/UsdValueText.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::size_t kShown = 200; // characters of a value

std::string cut(std::string text) {
    if (text.size() > kShown) text = text.substr(0, kShown) + "...";
    return text;
}

std::string typeText(UsdType type) {
    return std::to_string(int(type.kind)) + ":" + std::to_string(type.rows) + "x" +
           std::to_string(type.columns) + (type.array ? "[]" : "") + (type.quaternion ? "q" : "");
}

bool sameValue(const UsdValue& a, const UsdValue& b);

// Entries in any order.
bool sameDictionary(const UsdDictionary& a, const UsdDictionary& b) {
    if (a.size() != b.size()) return false;
    for (const UsdNamedValue& entry : a) {
        const auto other =
            std::find_if(b.begin(), b.end(), [&](const auto& e) { return e.name == entry.name; });
        if (other == b.end() || other->typeName != entry.typeName ||
            !sameValue(other->value, entry.value))
            return false;
    }
    return true;
}

bool sameValue(const UsdValue& a, const UsdValue& b) {
    if (a.type != b.type || a.data.index() != b.data.index()) return false;
    if (a.dictionary()) return sameDictionary(*a.dictionary(), *b.dictionary());
    const auto sameNumbers = [](const auto& x, const auto& y) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](auto p, auto q) {
            return p == q || (p != p && q != q); // NaN
        });
    };
    if (const auto* floats = a.as<float>()) return sameNumbers(*floats, *b.as<float>());
    if (const auto* doubles = a.as<double>()) return sameNumbers(*doubles, *b.as<double>());
    return a == b;
}

class Comparison {
public:
    std::string compare(const UsdLayer& a, const UsdLayer& b) {
        at_ = "layer";
        dictionaries("metadata", a.metadata, b.metadata);
        same("sublayers", a.subLayers.size(), b.subLayers.size());
        for (std::size_t i = 0; found_.empty() && i < a.subLayers.size(); ++i) {
            same("sublayer", a.subLayers[i].asset, b.subLayers[i].asset);
            offsets(a.subLayers[i].offset, b.subLayers[i].offset);
        }
        same("relocates", a.relocates.size(), b.relocates.size());
        for (std::size_t i = 0; found_.empty() && i < a.relocates.size(); ++i) {
            same("relocate", a.relocates[i].source, b.relocates[i].source);
            same("relocate", a.relocates[i].target, b.relocates[i].target);
        }
        prims("", a.prims, b.prims);
        return found_;
    }

private:
    void differ(const std::string& what, const std::string& a, const std::string& b) {
        if (found_.empty()) found_ = at_ + " " + what + ": " + cut(a) + " | " + cut(b);
    }
    void same(const std::string& what, const std::string& a, const std::string& b) {
        if (a != b) differ(what, a, b);
    }
    void same(const std::string& what, std::size_t a, std::size_t b) {
        same(what, std::to_string(a), std::to_string(b));
    }
    void values(const std::string& what, const UsdValue& a, const UsdValue& b) {
        if (!sameValue(a, b))
            differ(what, typeText(a.type) + " " + usdText(a), typeText(b.type) + " " + usdText(b));
    }
    void offsets(UsdLayerOffset a, UsdLayerOffset b) {
        const auto equal = [](double x, double y) { return x == y || (x != x && y != y); };
        if (!equal(a.offset, b.offset) || !equal(a.scale, b.scale))
            differ("offset", std::to_string(a.offset), std::to_string(b.offset));
    }
    void dictionaries(const std::string& what, const UsdDictionary& a, const UsdDictionary& b) {
        for (const UsdNamedValue& entry : a)
            if (const UsdValue* other = find(b, entry.name))
                values(what + " " + entry.name, entry.value, *other);
            else
                differ(what + " " + entry.name, "present", "absent");
        for (const UsdNamedValue& entry : b)
            if (!find(a, entry.name)) differ(what + " " + entry.name, "absent", "present");
        if (!sameDictionary(a, b)) differ(what, "types", "or order");
    }

    void items(const std::string& what, const std::string& a, const std::string& b) {
        same(what, a, b);
    }
    void items(const std::string& what, const UsdReference& a, const UsdReference& b) {
        same(what, a.asset, b.asset);
        same(what, a.path, b.path);
        offsets(a.offset, b.offset);
        dictionaries(what + " customData", a.customData, b.customData);
    }
    template <class Item>
    void edits(const std::string& what, UsdListEdits<Item> a, UsdListEdits<Item> b) {
        const auto byOp = [](const auto& x, const auto& y) { return x.op < y.op; };
        std::sort(a.begin(), a.end(), byOp);
        std::sort(b.begin(), b.end(), byOp);
        same(what + " edits", a.size(), b.size());
        for (std::size_t i = 0; found_.empty() && i < a.size(); ++i) {
            same(what + " op", std::size_t(a[i].op), std::size_t(b[i].op));
            same(what + " items", a[i].items.size(), b[i].items.size());
            for (std::size_t j = 0; found_.empty() && j < a[i].items.size(); ++j)
                items(what, a[i].items[j], b[i].items[j]);
        }
    }
    void arcs(const UsdPrimSpec& a, const UsdPrimSpec& b) {
        const UsdArcs none;
        const UsdArcs& x = a.arcs ? *a.arcs : none;
        const UsdArcs& y = b.arcs ? *b.arcs : none;
        edits("references", x.references, y.references);
        edits("payloads", x.payloads, y.payloads);
        edits("inherits", x.inherits, y.inherits);
        edits("specializes", x.specializes, y.specializes);
        edits("variantSetNames", x.variantSetNames, y.variantSetNames);
        edits("apiSchemas", x.apiSchemas, y.apiSchemas);
        dictionaries("variants", x.variants, y.variants);
    }
    void properties(const UsdProperty& a, const UsdProperty& b) {
        same("type", a.typeName + typeText(a.type), b.typeName + typeText(b.type));
        const auto flags = [](const UsdProperty& p) {
            return std::string(p.relationship ? "rel " : "") + (p.custom ? "custom " : "") +
                   (p.uniform ? "uniform " : "") + (p.varying ? "varying " : "") +
                   (p.hasSamples ? "samples" : "");
        };
        same("flags", flags(a), flags(b));
        values("default", a.value, b.value);
        same("samples", a.samples.size(), b.samples.size());
        for (std::size_t i = 0; found_.empty() && i < a.samples.size(); ++i) {
            if (a.samples[i].time != b.samples[i].time) differ("time", "", "");
            values("sample", a.samples[i].value, b.samples[i].value);
        }
        edits("targets", a.targets, b.targets);
        dictionaries("metadata", a.metadata, b.metadata);
    }
    template <class Named>
    bool names(const std::string& what, const std::vector<Named>& a, const std::vector<Named>& b) {
        const auto list = [](const std::vector<Named>& all) {
            std::string text;
            for (const Named& one : all) text += one.name + " ";
            return text;
        };
        same(what, list(a), list(b));
        return found_.empty();
    }
    void prims(const std::string& parent, const std::vector<UsdPrimSpec>& a,
               const std::vector<UsdPrimSpec>& b) {
        if (!names("prims", a, b)) return;
        for (std::size_t i = 0; found_.empty() && i < a.size(); ++i)
            body(parent + "/" + a[i].name, a[i], b[i]);
    }
    void body(const std::string& path, const UsdPrimSpec& a, const UsdPrimSpec& b) {
        at_ = "<" + path + ">";
        same("specifier", std::size_t(a.specifier), std::size_t(b.specifier));
        same("type", a.typeName, b.typeName);
        dictionaries("metadata", a.metadata, b.metadata);
        arcs(a, b);
        if (!names("properties", a.properties, b.properties)) return;
        for (std::size_t i = 0; found_.empty() && i < a.properties.size(); ++i) {
            at_ = "<" + path + "." + a.properties[i].name + ">";
            properties(a.properties[i], b.properties[i]);
        }
        at_ = "<" + path + ">";
        if (!names("variant sets", a.variantSets, b.variantSets)) return;
        for (std::size_t i = 0; found_.empty() && i < a.variantSets.size(); ++i) {
            const auto &x = a.variantSets[i], &y = b.variantSets[i];
            if (!names("variants", x.variants, y.variants)) return;
            for (std::size_t j = 0; found_.empty() && j < x.variants.size(); ++j)
                body(path + "{" + x.name + "=" + x.variants[j].name + "}", x.variants[j],
                     y.variants[j]);
        }
        prims(path, a.children, b.children);
    }

    std::string at_, found_;
};

} // namespace

std::string differenceOf(const UsdLayer& a, const UsdLayer& b) {
    return Comparison().compare(a, b);
}

} // namespace penumbra
