// What libFuzzer calls. The names are its own.
#pragma once

#include "tests/fuzz/FuzzRandom.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

extern "C" {
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                    unsigned seed);
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);
}

namespace penumbra {

inline std::string_view fuzzBytes(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Ends the process, as a crash does, if something is wrong.
inline int reportFuzzFault(const std::string& fault) {
    if (fault.empty()) return 0;
    std::fprintf(stderr, "fault: %s\n", fault.c_str());
    std::abort();
}

/// Puts what a mutator made in the place of the input; cut off where it is too large.
inline std::size_t giveBack(const std::string& made, std::uint8_t* data, std::size_t maxSize) {
    const std::size_t size = std::min(made.size(), maxSize);
    std::memcpy(data, made.data(), size);
    return size;
}

} // namespace penumbra
