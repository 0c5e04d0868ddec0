// Following the connections of shaders.
#pragma once

#include "io/usd/stage/UsdStage.h"

#include <string>

namespace penumbra {

/// Where the value of an input is.
struct UsdSource {
    enum class Kind {
        value,    ///< authored at `attribute` of `prim`, if at all
        computed, ///< `attribute` is an output of the shader `prim`
        missing,  ///< what `attribute` of `prim` is connected to is not there
        circle    ///< connections run in a circle
    };
    Kind kind = Kind::value;
    const UsdPrim* prim = nullptr; ///< never null
    std::string attribute;
    std::string target = {}; ///< if it is missing: its path
};

/// Follows the connections of an attribute, through materials and node graphs.
UsdSource usdSourceOf(const UsdStage& stage, const UsdPrim& prim, const std::string& attribute);

inline constexpr int kMostConnections = 64; ///< of a chain; also ends circles

} // namespace penumbra
