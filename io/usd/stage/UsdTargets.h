// Targets of relationships and sources of connections, as the whole stage names them.
#pragma once

#include "io/usd/compose/UsdMapping.h"

#include <functional>
#include <string>
#include <vector>

namespace penumbra {

/// One spec's opinion about the targets of a property.
struct UsdTargetOpinion {
    const UsdProperty* property = nullptr;
    const UsdMapping* toStage = nullptr; ///< null: the identity
};

struct UsdComposedTargets {
    std::vector<std::string> paths;
    std::vector<std::string> deleted; ///< by some opinion
    /// Targets that are no part of what an arc brought, by the number of the opinion.
    std::vector<std::pair<std::size_t, std::string>> unmapped;
};

/// Combines opinions, strongest first. \param allowed if not empty: whether the target, as the
/// stage names it, of an opinion may be there
UsdComposedTargets
composeTargets(const std::vector<UsdTargetOpinion>& opinions,
               const std::function<bool(std::size_t, const std::string&)>& allowed = {});

} // namespace penumbra
