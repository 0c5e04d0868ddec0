// libFuzzer on the layers of a scene.
#include "tests/fuzz/FuzzTargets.h"
#include "tests/fuzz/Fuzzer.h"
#include "tests/fuzz/TokenMutator.h"

using namespace penumbra;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return reportFuzzFault(tryComposition(fuzzBytes(data, size)));
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                    unsigned seed) {
    FuzzRandom random(seed);
    if (random.one(20)) return LLVMFuzzerMutate(data, size, maxSize);
    const auto& pool = random.one(5) ? layerStatements() : arcStatements();
    return giveBack(mutatedText(fuzzBytes(data, size), pool, random), data, maxSize);
}
