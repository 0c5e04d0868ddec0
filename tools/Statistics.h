// The JSON of --stats.
#pragma once

#include <string>

namespace penumbra {

class SceneSolution;
struct SolveStatistics;

/// Writes what a solution cost: scene, solve, sffl, memory, phases. Keys may be added, never
/// renamed. \throws Error if the file can't be written
void writeStatistics(const std::string& path, const SceneSolution& solution);

/// What a solution may still be wrong by, for people, beside how bright it is: see LitLevel.
std::string certificateSummary(const SolveStatistics& statistics);
/// One line where the certificate is as large as the light itself; empty where it is not.
std::string certificateWarning(const SolveStatistics& statistics);

/// Largest resident size of this process so far [bytes].
std::size_t peakMemory();

} // namespace penumbra
