#include "tests/io/model/LayerParts.h"

#include "io/usd/text/UsdLayerWriter.h"
#include "tests/io/usd/crate/LayerDifference.h"

#include <algorithm>
#include <limits>
#include <sstream>

namespace penumbra {

namespace {

const UsdProperty* propertyAt(const UsdLayer& layer, const std::string& prim,
                              const std::string& name) {
    const UsdPrimSpec* spec = primAt(layer, prim);
    return spec ? spec->property(name) : nullptr;
}

} // namespace

const UsdPrimSpec* primAt(const UsdLayer& layer, const std::string& path) {
    const std::vector<UsdPrimSpec>* below = &layer.prims;
    const UsdPrimSpec* found = nullptr;
    std::istringstream names(path.substr(1));
    for (std::string name; std::getline(names, name, '/');) {
        const auto spec = std::find_if(below->begin(), below->end(),
                                       [&](const auto& one) { return one.name == name; });
        if (spec == below->end()) return nullptr;
        found = &*spec;
        below = &spec->children;
    }
    return found;
}

double numberIn(const UsdDictionary& metadata, const std::string& name) {
    const UsdValue* value = find(metadata, name);
    return value && value->numbers().size() == 1 ? value->numbers().front()
                                                 : std::numeric_limits<double>::quiet_NaN();
}

std::string textIn(const UsdDictionary& metadata, const std::string& name) {
    const UsdValue* value = find(metadata, name);
    return value && value->text() ? *value->text() : std::string();
}

std::vector<double> numbersOf(const UsdLayer& layer, const std::string& prim,
                              const std::string& attribute) {
    const UsdProperty* property = propertyAt(layer, prim, attribute);
    return property ? property->value.numbers() : std::vector<double>();
}

std::string textOf(const UsdLayer& layer, const std::string& prim, const std::string& attribute) {
    const UsdProperty* property = propertyAt(layer, prim, attribute);
    return property && property->value.text() ? *property->value.text() : std::string();
}

std::string interpolationOf(const UsdLayer& layer, const std::string& prim,
                            const std::string& attribute) {
    const UsdProperty* property = propertyAt(layer, prim, attribute);
    return property ? textIn(property->metadata, "interpolation") : std::string();
}

std::string targetOf(const UsdLayer& layer, const std::string& prim, const std::string& name) {
    const UsdProperty* property = propertyAt(layer, prim, name);
    return property && property->targets.size() == 1 && property->targets[0].items.size() == 1
               ? property->targets[0].items[0]
               : std::string();
}

bool says(const ImportedModel& model, const std::string& text) {
    return std::any_of(
        model.layer.diagnostics.begin(), model.layer.diagnostics.end(),
        [&](const Diagnostic& one) { return one.text.find(text) != std::string::npos; });
}

std::string differenceAfterWriting(const UsdLayer& layer) {
    return differenceOf(layer, parseUsdLayer(usdLayerText(layer), layer.file));
}

} // namespace penumbra
