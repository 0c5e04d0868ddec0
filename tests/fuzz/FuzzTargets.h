// What the fuzzers try: any bytes must be understood, or refused by one line.
#pragma once

#include "tests/fuzz/FuzzRandom.h"

#include <optional>
#include <string>
#include <string_view>

namespace penumbra {

/// Each returns what is wrong with the answer to the bytes, in words; empty if nothing is. A crash,
/// a run without end and memory without bounds are for the fuzzer to find.

/// A layer of USD text: read, written and read again it is the same.
std::string tryText(std::string_view bytes);
/// A crate file: what was read of it survives being written as text.
std::string tryCrate(std::string_view bytes);
/// The layers of a scene, the text of each behind a line `---`; the first one is opened. They are
/// composed, reported, flattened and loaded; nothing from outside of their folder comes in.
std::string tryComposition(std::string_view bytes);

/// What is tried, and how inputs of its kind are changed.
struct FuzzTarget {
    const char* name;
    std::string (*attempt)(std::string_view bytes);
    /// An input with one change; nothing if it is none of that kind.
    std::optional<std::string> (*mutated)(std::string_view bytes, FuzzRandom& random);
    std::size_t rarely; ///< one change out of so many is made by the fuzzer itself, byte by byte
};
FuzzTarget textTarget();
FuzzTarget crateTarget();
FuzzTarget compositionTarget();

} // namespace penumbra
