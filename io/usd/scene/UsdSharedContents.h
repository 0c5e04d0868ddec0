// Instances of one thing: what is below them need not be made twice.
#pragma once

#include "io/usd/stage/UsdStage.h"

#include <cstdint>
#include <string>
#include <unordered_map>

namespace penumbra {

/// Finds instances (UsdPrim::instance) of which all descendants have the same opinions: the same
/// specs of the same layers at the same times, in the same order. The values of an instance's
/// descendants come from what its arcs bring, so these differ in nothing but their paths, and what
/// the instances themselves hand down.
class UsdSharedContents {
public:
    explicit UsdSharedContents(const UsdStage& stage) : stage_(stage) {}

    /// The first instance that was asked for and has the contents of `instance`, maybe itself.
    /// \param instance index of a prim, see UsdStage::prims()
    std::uint32_t originalOf(std::uint32_t instance);
    /// A path at or below `copy` as it is in its original; others are as they were.
    std::string inOriginal(const std::string& path, std::uint32_t copy,
                           std::uint32_t original) const;

private:
    std::string keyOf(std::uint32_t instance) const;

    const UsdStage& stage_;
    std::unordered_map<std::string, std::uint32_t> originals_;
};

} // namespace penumbra
