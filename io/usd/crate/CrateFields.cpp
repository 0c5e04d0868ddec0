#include "io/usd/crate/CrateFields.h"

#include <unordered_map>

namespace penumbra {

CrateFieldName crateFieldNamed(std::string_view name) {
    using enum CrateFieldName;
    static const std::unordered_map<std::string_view, CrateFieldName> kNames{
        {"apiSchemas", apiSchemas},
        {"connectionChildren", ignored},
        {"connectionPaths", connectionPaths},
        {"custom", custom},
        {"default", defaultValue},
        {"expressionChildren", ignored},
        {"inheritPaths", inheritPaths},
        {"layerRelocates", layerRelocates},
        {"mapperChildren", ignored},
        {"mapperArgChildren", ignored},
        {"payload", payload},
        {"primChildren", primChildren},
        {"primOrder", primOrder},
        {"properties", properties},
        {"propertyOrder", propertyOrder},
        {"references", references},
        {"specializes", specializes},
        {"specifier", specifier},
        {"spline", spline},
        {"subLayerOffsets", subLayerOffsets},
        {"subLayers", subLayers},
        {"targetChildren", ignored},
        {"targetPaths", targetPaths},
        {"timeSamples", timeSamples},
        {"typeName", typeName},
        {"variability", variability},
        {"variantChildren", variantChildren},
        {"variantSelection", variantSelection},
        {"variantSetChildren", variantSetChildren},
        {"variantSetNames", variantSetNames},
    };
    constexpr std::size_t kLongest = 32; // a name of a megabyte is not worth hashing
    const auto found = name.size() > kLongest ? kNames.end() : kNames.find(name);
    return found == kNames.end() ? metadata : found->second;
}

std::string_view usdMetadataKey(std::string_view field) {
    return field == "documentation" ? "doc" : field;
}

} // namespace penumbra
