// What libFuzzer calls, under its own names, for one of the targets: PENUMBRA_FUZZ_TARGET.
#include "tests/fuzz/FuzzTargets.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                    unsigned seed);
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);
}

namespace {

std::string_view bytesOf(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

} // namespace

// Ends the process, as a crash does, if something is wrong.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string fault = penumbra::PENUMBRA_FUZZ_TARGET().attempt(bytesOf(data, size));
    if (fault.empty()) return 0;
    std::fprintf(stderr, "fault: %s\n", fault.c_str());
    std::abort();
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                    unsigned seed) {
    const penumbra::FuzzTarget target = penumbra::PENUMBRA_FUZZ_TARGET();
    penumbra::FuzzRandom random(seed);
    if (random.one(target.rarely)) return LLVMFuzzerMutate(data, size, maxSize);
    const auto made = target.mutated(bytesOf(data, size), random);
    if (!made) return LLVMFuzzerMutate(data, size, maxSize);
    const std::size_t taken = std::min(made->size(), maxSize); // cut off where it is too large
    std::memcpy(data, made->data(), taken);
    return taken;
}
