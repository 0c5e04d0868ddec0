// Names of the fields of specs.
#pragma once

#include "io/usd/crate/CrateTables.h"

#include <string_view>

namespace penumbra {

/// Fields with a meaning of their own; all others are metadata.
enum class CrateFieldName : std::uint8_t {
    metadata,
    ignored, ///< what the specs say by themselves
    apiSchemas,
    connectionPaths,
    custom,
    defaultValue,
    inheritPaths,
    layerRelocates,
    payload,
    primChildren,
    primOrder,
    properties,
    propertyOrder,
    references,
    specializes,
    specifier,
    spline,
    subLayerOffsets,
    subLayers,
    targetPaths,
    timeSamples,
    typeName,
    variability,
    variantChildren,
    variantSelection,
    variantSetChildren,
    variantSetNames,
};

CrateFieldName crateFieldNamed(std::string_view name);

/// How the text format calls a field that is metadata.
std::string_view usdMetadataKey(std::string_view field);

} // namespace penumbra
