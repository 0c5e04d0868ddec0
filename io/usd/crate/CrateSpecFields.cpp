#include "io/usd/crate/CrateSpecFields.h"

#include "io/usd/crate/CrateFields.h"
#include "io/usd/crate/CrateListOps.h"
#include "io/usd/crate/CrateMetadata.h"
#include "io/usd/crate/CrateValues.h"
#include "io/usd/layer/UsdMetadataParser.h"
#include "io/usd/layer/UsdPath.h"

#include <algorithm>

namespace penumbra {

namespace {

// `Mesh`, `ns::Type`, `a.b`.
bool isTypeName(std::string_view name) {
    while (!name.empty()) {
        const std::size_t end = std::min(name.find('.'), name.find("::"));
        if (!isUsdIdentifier(name.substr(0, end))) return false;
        if (end == std::string_view::npos) return true;
        name.remove_prefix(end + (name[end] == '.' ? 1 : 2));
        if (name.empty()) return false;
    }
    return true;
}

std::string typeName(CrateFile& file, CrateRep rep) {
    if (rep.type() != CrateType::token || rep.array())
        throw CrateFault(rep.payload(), "a type's name is no token");
    const std::string_view name = file.token(rep.low(), rep.payload());
    if (name.size() > 1024 || !isTypeName(name))
        throw CrateFault(rep.payload(), "an impossible name of a type");
    return file.copied(name, rep.payload());
}

UsdSpecifier specifier(CrateRep rep) {
    if (rep.low() > 2) throw CrateFault(rep.payload(), "an unknown specifier");
    return rep.low() == 0   ? UsdSpecifier::def
           : rep.low() == 1 ? UsdSpecifier::over
                            : UsdSpecifier::classes;
}

// Inherits and specializes: paths of prims.
UsdListEdits<std::string> classPaths(CrateFile& file, CrateRep rep) {
    if (rep.type() != CrateType::pathListOp)
        throw CrateFault(rep.payload(), "classes are no list of paths");
    UsdListEdits<std::string> edits = crateTextEdits(file, rep);
    for (const auto& edit : edits)
        for (const std::string& path : edit.items)
            if (isUsdPropertyPath(path) || !path.starts_with('/'))
                throw CrateFault(rep.payload(), "<" + path + "> is not the path of a prim");
    return edits;
}

void readSubLayers(CrateFile& file, CrateRep rep, UsdLayer& layer) {
    std::vector<std::string> assets = crateStrings(file, rep);
    for (const std::string& asset : assets)
        if (!isUsdAssetPath(asset)) throw CrateFault(rep.payload(), "an impossible asset path");
    for (std::string& asset : assets) layer.subLayers.push_back({std::move(asset), {}, {}});
}

bool isArc(CrateFieldName name) {
    using enum CrateFieldName;
    return name == apiSchemas || name == inheritPaths || name == payload || name == references ||
           name == specializes || name == variantSelection || name == variantSetNames;
}

void readArc(CrateFile& file, CrateFieldName name, CrateRep rep, UsdPrimSpec& spec) {
    if (!spec.arcs) spec.arcs = std::make_unique<UsdArcs>();
    UsdArcs& arcs = *spec.arcs;
    if (name == CrateFieldName::apiSchemas) arcs.apiSchemas = crateTextEdits(file, rep);
    if (name == CrateFieldName::inheritPaths) arcs.inherits = classPaths(file, rep);
    if (name == CrateFieldName::payload) arcs.payloads = crateReferenceEdits(file, rep);
    if (name == CrateFieldName::references) arcs.references = crateReferenceEdits(file, rep);
    if (name == CrateFieldName::specializes) arcs.specializes = classPaths(file, rep);
    if (name == CrateFieldName::variantSelection) arcs.variants = crateVariantSelections(file, rep);
    if (name == CrateFieldName::variantSetNames) arcs.variantSetNames = crateTextEdits(file, rep);
}

} // namespace

void readCrateLayerField(CrateFile& file, std::string_view name, CrateRep rep, UsdLayer& layer,
                         CrateChildren& children) {
    switch (crateFieldNamed(name)) {
    case CrateFieldName::primChildren:
        children.prims = crateTokens(file, rep);
        return;
    case CrateFieldName::ignored:
    case CrateFieldName::properties:
        return;
    case CrateFieldName::subLayers:
        return readSubLayers(file, rep, layer);
    case CrateFieldName::subLayerOffsets:
        children.subLayerOffsets = crateLayerOffsets(file, rep);
        return;
    case CrateFieldName::layerRelocates:
        layer.relocates = crateRelocates(file, rep);
        return;
    case CrateFieldName::primOrder:
        return assign(layer.metadata, {"reorder rootPrims", {}, crateNameOrder(file, rep)});
    default:
        if (name == "relocates") throw CrateFault(rep.payload(), "relocates that are metadata");
        return addCrateMetadata(file, name, rep, layer.metadata);
    }
}

void readCratePrimField(CrateFile& file, std::string_view name, CrateRep rep, UsdPrimSpec& spec,
                        CrateChildren& children) {
    const CrateFieldName field = crateFieldNamed(name);
    switch (field) {
    case CrateFieldName::ignored:
        return;
    case CrateFieldName::specifier:
        spec.specifier = specifier(rep);
        return;
    case CrateFieldName::typeName:
        spec.typeName = typeName(file, rep);
        return;
    case CrateFieldName::primChildren:
        children.prims = crateTokens(file, rep);
        return;
    case CrateFieldName::properties:
        children.properties = crateTokens(file, rep);
        return;
    case CrateFieldName::variantSetChildren:
        children.variantSets = crateTokens(file, rep);
        return;
    case CrateFieldName::primOrder:
        return assign(spec.metadata, {"reorder nameChildren", {}, crateNameOrder(file, rep)});
    case CrateFieldName::propertyOrder:
        return assign(spec.metadata, {"reorder properties", {}, crateNameOrder(file, rep)});
    default:
        if (isArc(field)) return readArc(file, field, rep, spec);
        if (isUsdArcKey(name)) throw CrateFault(rep.payload(), "arcs that are metadata");
        return addCrateMetadata(file, name, rep, spec.metadata);
    }
}

} // namespace penumbra
