// A composition spelt out, for tests and for people.
#pragma once

#include "io/usd/stage/UsdComposition.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace penumbra {

/// The times of a node or of a layer of its stack.
struct UsdTimeReport {
    std::string layer; ///< of a node: the root layer of its stack
    std::string prim;  ///< of a node
    std::string type;  ///< the arc; `sublayer`
    UsdLayerOffset offset;
    std::vector<UsdTimeReport> children;
};

/// What one prim is composed of. Layers are named relative to the folder of the root layer.
struct UsdPrimReport {
    using Sites = std::vector<std::pair<std::string, std::string>>; ///< layer, path
    using Paths = std::map<std::string, std::vector<std::string>>;  ///< by property
    std::string path;
    Sites primStack;
    std::vector<UsdTimeReport> times; ///< empty if all times are those of the stage
    std::vector<std::string> childNames, prohibited;
    std::map<std::string, std::string> variants;
    std::vector<std::string> properties;
    std::map<std::string, Sites> propertyStacks;
    Paths targets, connections, deleted;
};

/// Names of the layers of the root layer's stack.
std::vector<std::string> layerNames(const UsdComposition& composition);

/// Calls `take` with each prim of a composition, depth first. Says which targets and properties are
/// wrong, among the composition's errors. One rule is followed here only, not by the stage: targets
/// in a class that name what inherits it are left out.
void reportComposition(UsdComposition& composition,
                       const std::function<void(const UsdPrimReport&)>& take);

} // namespace penumbra
