// Where results go: they must not overwrite what is read, nor one another.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra {

struct FrameRange;

/// All names that a pattern gives when frames are played, see numberedPath(); an empty pattern
/// gives none.
std::vector<std::string> everyName(const std::string& pattern, FrameRange frames);

/// Fails before the work when a result could not be written after it (no such folder, no
/// permission, a folder in its place), and when it would overwrite a file that is read or
/// another result: under whatever name, so also through a symbolic link or as a hard link.
/// \param read    files that are read: the scene's layers, sensor lists; need not exist
/// \param outputs names of results; empty ones and "-", standard output, are left out
/// \throws Error, CLI::ValidationError
void checkOutputs(const std::vector<std::filesystem::path>& read,
                  const std::vector<std::string>& outputs);

/// Sees to it that all that was printed has arrived. \throws Error if it has not
void finishStandardOutput();

} // namespace penumbra
