// The two ways in which crate files pack bytes: LZ4, and a coding of integers that are much alike.
#pragma once

#include "io/usd/crate/CrateBytes.h"

#include <cstdlib>
#include <memory>
#include <vector>

namespace penumbra {

struct FreeMemory {
    void operator()(std::byte* memory) const { std::free(memory); }
};

/// Bytes that were unpacked. The memory is zero at first, and costs nothing before it is used.
struct CrateBuffer {
    std::unique_ptr<std::byte[], FreeMemory> data;
    std::size_t size = 0;
    std::span<const std::byte> bytes() const { return {data.get(), size}; }
};

/// Unpacks a buffer: byte 0 is the number of chunks, each an int32 size and a raw LZ4 block; with 0
/// the rest is one block. Never makes more than `most` bytes, nor more than LZ4 can make of so few.
/// \param byte where `packed` is in the file, for what faults say
CrateBuffer unpackCrateBuffer(std::span<const std::byte> packed, std::uint64_t most,
                              std::uint64_t byte);

/// Memory for `size` bytes.
CrateBuffer makeCrateBuffer(std::size_t size);

/// Reads `count` integers, stored as their packed size and a buffer. Unpacked, it holds the
/// commonest difference, a code of two bits a number, and literals; a number is the one before plus
/// its difference, modulo 2^32 (or 2^64).
/// \tparam Int (u)int32 or (u)int64
template <class Int>
std::vector<Int> takeCrateIntegers(CrateBytes& in, std::uint64_t count);

} // namespace penumbra
