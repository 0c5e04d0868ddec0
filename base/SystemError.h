// What the operating system refuses, in our own words.
#pragma once

#include <string>

namespace penumbra {

enum class FileUse { read, write };

/// Why the system refuses a file, and what to do: `reason (advice)`.
/// \param errorNumber of errno
std::string reasonOf(int errorNumber, FileUse use);

/// \throws Error `path: error: can't read: reason (advice)`, or `can't write`
[[noreturn]] void failToUse(const std::string& path, int errorNumber, FileUse use);

/// Why a file can't be read, as reasonOf() says it; empty if it is there, no folder, and may be
/// read.
std::string whyUnreadable(const std::string& path);

} // namespace penumbra
