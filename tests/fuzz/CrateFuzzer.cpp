// libFuzzer on crate files.
#include "tests/fuzz/CrateMutator.h"
#include "tests/fuzz/FuzzTargets.h"
#include "tests/fuzz/Fuzzer.h"

using namespace penumbra;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return reportFuzzFault(tryCrate(fuzzBytes(data, size)));
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                    unsigned seed) {
    FuzzRandom random(seed);
    const auto made = random.one(8) ? std::nullopt : mutatedCrate(fuzzBytes(data, size), random);
    return made ? giveBack(*made, data, maxSize) : LLVMFuzzerMutate(data, size, maxSize);
}
