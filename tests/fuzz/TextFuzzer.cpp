// libFuzzer on layers of USD text.
#include "tests/fuzz/FuzzTargets.h"
#include "tests/fuzz/Fuzzer.h"
#include "tests/fuzz/TokenMutator.h"

using namespace penumbra;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return reportFuzzFault(tryText(fuzzBytes(data, size)));
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                    unsigned seed) {
    FuzzRandom random(seed);
    if (random.one(5)) return LLVMFuzzerMutate(data, size, maxSize);
    return giveBack(mutatedText(fuzzBytes(data, size), layerStatements(), random), data, maxSize);
}
