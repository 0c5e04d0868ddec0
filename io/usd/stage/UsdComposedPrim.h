// What the index of a prim comes to: its stack of specs, its children.
#pragma once

#include "io/usd/compose/UsdPrimIndex.h"

#include <string>
#include <vector>

namespace penumbra {

/// One spec of a prim.
struct UsdComposedSpec {
    const UsdPrimSpec* spec = nullptr;
    const UsdStackedLayer* layer = nullptr;
    std::uint32_t node = 0;
};

/// All specs of a prim, strongest first.
std::vector<UsdComposedSpec> primStack(const UsdPrimIndex& index);

struct UsdChildNames {
    std::vector<std::string> names;      ///< in their order
    std::vector<std::string> prohibited; ///< sorted: what was relocated away
};
UsdChildNames childNames(const UsdPrimIndex& index);

} // namespace penumbra
