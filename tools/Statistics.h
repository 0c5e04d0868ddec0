// The JSON of --stats.
#pragma once

#include <string>

namespace penumbra {

class SceneSolution;

/// Writes what a solution cost: scene, solve, sffl, memory, phases. Keys may be added, never
/// renamed. \throws Error if the file can't be written
void writeStatistics(const std::string& path, const SceneSolution& solution);

/// Largest resident size of this process so far [bytes].
std::size_t peakMemory();

} // namespace penumbra
