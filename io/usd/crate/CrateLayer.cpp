#include "io/usd/crate/CrateLayer.h"

#include "io/usd/crate/CrateFields.h"
#include "io/usd/crate/CrateProperties.h"
#include "io/usd/crate/CrateSpecFields.h"
#include "io/usd/crate/CrateSpecs.h"
#include "io/usd/crate/CrateValues.h"
#include "io/usd/layer/UsdText.h"

#include <algorithm>

namespace penumbra {

namespace {

constexpr std::uint32_t kNone = CratePaths::kNone;

class LayerBuilder {
public:
    LayerBuilder(CrateFile& file, const std::string& name, const UsdLayerLimits& limits)
        : file_(file), warnings_(name), specs_(file, warnings_), properties_(file),
          limits_(limits) {
        layer_.file = name;
    }

    UsdLayer build();

private:
    /// A prim or variant whose fields are still to be read.
    struct Open {
        UsdPrimSpec* spec;
        std::uint32_t path;
    };

    void root(std::uint32_t path);
    void body(const Open& open);
    void addPrims(const std::vector<std::uint32_t>& names, std::uint32_t parent,
                  std::vector<UsdPrimSpec>& prims);
    void addProperties(const std::vector<std::uint32_t>& names, const Open& open);
    void addVariantSets(const std::vector<std::uint32_t>& names, const Open& open);
    void addVariants(std::uint32_t set, const Open& open, UsdVariantSet& variantSet);
    void countPrims(std::size_t more) {
        primCount_ += more;
        file_.budget.spend(CrateBudget::kSpec * more, 0);
        if (primCount_ > limits_.prims) throw CrateRefused(0, "too many prims");
    }

    template <class Read>
    void fieldsOf(std::uint32_t path, Read read);

    void warnOfField(std::uint32_t path, std::string_view field, const std::string& why);

    CrateFile& file_;
    CrateWarnings warnings_;
    CrateSpecs specs_;
    CratePropertyReader properties_;
    UsdLayerLimits limits_;
    UsdLayer layer_;
    std::size_t primCount_ = 0;
    std::vector<Open> open_;
};

void LayerBuilder::warnOfField(std::uint32_t path, std::string_view field, const std::string& why) {
    const std::string where = file_.tables.paths.text(path, file_.tables.tokens);
    warnings_.warn("'" + printable(field) + "' of <" + where + "> left out: " + why);
}

// Calls `read(name, rep)` for each field; one that can't be read is left out.
template <class Read>
void LayerBuilder::fieldsOf(std::uint32_t path, Read read) {
    const std::uint32_t set = specs_.at(path)->fieldSet;
    visitCrateFields(file_, set, [&](std::string_view name, const CrateField& field) {
        try {
            read(name, field.value);
        } catch (const CrateRefused&) {
            throw;
        } catch (const CrateFault& fault) {
            warnOfField(path, name, fault.what());
        }
    });
}

UsdLayer LayerBuilder::build() {
    const std::uint32_t path = file_.tables.paths.root();
    if (path != kNone && specs_.at(path)) root(path);
    while (!open_.empty()) {
        const Open next = open_.back();
        open_.pop_back();
        body(next);
    }
    if (file_.tables.badText) warnings_.warn("some text is not UTF-8: its bytes became '?'");
    layer_.diagnostics = warnings_.take();
    return std::move(layer_);
}

void LayerBuilder::root(std::uint32_t path) {
    CrateChildren children;
    fieldsOf(path, [&](std::string_view name, CrateRep rep) {
        readCrateLayerField(file_, name, rep, layer_, children);
    });
    const auto& offsets = children.subLayerOffsets;
    for (std::size_t i = 0; i < std::min(offsets.size(), layer_.subLayers.size()); ++i)
        layer_.subLayers[i].offset = offsets[i];
    addPrims(children.prims, path, layer_.prims);
}

void LayerBuilder::body(const Open& open) {
    CrateChildren children;
    fieldsOf(open.path, [&](std::string_view name, CrateRep rep) {
        readCratePrimField(file_, name, rep, *open.spec, children);
    });
    if (file_.tables.paths[open.path].kind == CratePaths::Kind::variant) {
        open.spec->specifier = UsdSpecifier::over; // text can't say more of a variant
        open.spec->typeName.clear();
    }
    addProperties(children.properties, open);
    addVariantSets(children.variantSets, open);
    addPrims(children.prims, open.path, open.spec->children);
}

// The list is complete before any of its prims is opened: their places don't change any more.
void LayerBuilder::addPrims(const std::vector<std::uint32_t>& names, std::uint32_t parent,
                            std::vector<UsdPrimSpec>& prims) {
    const std::vector<std::uint32_t> paths = specs_.prims(names, parent);
    countPrims(paths.size());
    prims.resize(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const CratePaths::Node& node = file_.tables.paths[paths[i]];
        if (node.depth > limits_.primDepth) throw CrateRefused(0, "prims nested too deeply");
        prims[i].specifier = UsdSpecifier::over;
        prims[i].name = file_.copied(file_.tables.tokens[node.token], 0);
        open_.push_back({&prims[i], paths[i]});
    }
}

void LayerBuilder::addProperties(const std::vector<std::uint32_t>& names, const Open& open) {
    const std::vector<std::uint32_t> paths = specs_.properties(names, open.path);
    file_.budget.spend(CrateBudget::kSpec * paths.size(), 0);
    auto& properties = open.spec->properties;
    properties.reserve(paths.size());
    for (const std::uint32_t path : paths) {
        UsdProperty& property = properties.emplace_back();
        property.name = file_.copied(file_.tables.tokens[file_.tables.paths[path].token], 0);
        const auto faults = [&](std::string_view field, const std::string& why) {
            warnOfField(path, field, why);
        };
        if (properties_.read(*specs_.at(path), property, faults)) continue;
        properties.pop_back();
        warnOfField(path, "typeName", "the attribute has no type, and is left out, too");
    }
}

void LayerBuilder::addVariantSets(const std::vector<std::uint32_t>& names, const Open& open) {
    auto& sets = open.spec->variantSets;
    sets.reserve(names.size());
    for (const std::uint32_t name : names) {
        const std::string_view setName = file_.tables.tokens[name];
        const std::uint32_t path = specs_.variant(open.path, setName, "");
        if (path == kNone) continue;
        UsdVariantSet& set = sets.emplace_back();
        set.name = setName;
        addVariants(path, open, set);
        if (set.variants.empty()) sets.pop_back(); // as in text, where such a set is a fault
    }
}

void LayerBuilder::addVariants(std::uint32_t set, const Open& open, UsdVariantSet& variantSet) {
    std::vector<std::uint32_t> choices;
    fieldsOf(set, [&](std::string_view name, CrateRep rep) {
        if (crateFieldNamed(name) == CrateFieldName::variantChildren)
            choices = crateTokens(file_, rep);
    });
    countPrims(choices.size());
    variantSet.variants.reserve(choices.size());
    for (const std::uint32_t name : choices) {
        const std::string_view choice = file_.tables.tokens[name];
        const std::uint32_t path =
            choice.empty() ? kNone : specs_.variant(open.path, variantSet.name, choice);
        if (path == kNone) continue;
        UsdPrimSpec& spec = variantSet.variants.emplace_back();
        spec.specifier = UsdSpecifier::over;
        spec.name = file_.copied(choice, 0);
        open_.push_back({&spec, path});
    }
}

} // namespace

bool isCrate(std::string_view begin) {
    return begin.starts_with("PXR-USDC");
}

UsdLayer readCrateLayer(std::span<const std::byte> bytes, const std::string& file,
                        const UsdLayerLimits& limits) {
    try {
        CrateFile crate(bytes);
        return LayerBuilder(crate, file, limits).build();
    } catch (const CrateFault& fault) {
        throw SceneFileError({file, 0, 0}, std::string("damaged binary USD: ") + fault.what());
    }
}

} // namespace penumbra
