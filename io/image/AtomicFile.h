// Files that are there whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace penumbra {

/// Writes a file such that nobody ever meets half of it: the bytes go to a temporary name in the
/// same folder, which then replaces `path` in one step. When that fails, a file that was
/// there before is untouched and the temporary one is gone; so it is when a signal ends the
/// process, see UnfinishedFile.h. A symbolic link is followed; into a device or a pipe (/dev/null,
/// /dev/stdout) the bytes are written straight. \throws Error `path: error: can't write: reason
/// (advice)`, see SystemError.h
void writeFileAtomically(const std::string& path, std::span<const std::byte> bytes);
void writeFileAtomically(const std::string& path, std::string_view text);

/// The file that would be written: `path`, or what the symbolic links there lead to, which need not
/// exist.
std::filesystem::path writtenPlace(const std::filesystem::path& path);

} // namespace penumbra
