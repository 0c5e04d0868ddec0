#include "tests/fuzz/FuzzTargets.h"

#include "tests/fuzz/CrateMutator.h"
#include "tests/fuzz/TokenMutator.h"

namespace penumbra {

FuzzTarget textTarget() {
    const auto mutated = [](std::string_view bytes, FuzzRandom& random) {
        return std::optional(mutatedText(bytes, layerStatements(), random));
    };
    return {"text", tryText, mutated, 5};
}

FuzzTarget crateTarget() {
    return {"crate", tryCrate, mutatedCrate, 8};
}

FuzzTarget compositionTarget() {
    const auto mutated = [](std::string_view bytes, FuzzRandom& random) {
        const auto& pool = random.one(5) ? layerStatements() : arcStatements();
        return std::optional(mutatedText(bytes, pool, random));
    };
    return {"composition", tryComposition, mutated, 20};
}

} // namespace penumbra
