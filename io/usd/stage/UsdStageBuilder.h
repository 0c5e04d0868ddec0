// Puts the prims of a stage together.
#pragma once

#include "io/usd/stage/UsdComposedPrim.h"
#include "io/usd/stage/UsdStage.h"

#include <vector>

namespace penumbra {

/// Composes prim by prim, parents first. Each index lives until those of its children are made.
class UsdStageBuilder {
public:
    UsdStageBuilder(UsdStage& stage, const UsdComposeLimits& limits)
        : stage_(stage), composition_(*stage.composition_), limits_(limits) {}
    void build();

private:
    void addChildren(std::uint32_t parent);
    void addPrim(std::uint32_t parent, UsdPrimIndex index);
    bool mayAdd(std::size_t opinions);
    /// What is wrong with the targets of its properties.
    void checkTargets(const UsdPrim& prim);

    UsdStage& stage_;
    UsdComposition& composition_;
    UsdComposeLimits limits_;
    std::vector<UsdPrimIndex> indices_; // one a prim; empty when it is done
    std::size_t opinions_ = 0;
    bool full_ = false;
};

} // namespace penumbra
