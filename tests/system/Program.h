// The program as people run it: a process of its own, in a folder of its own.
#pragma once

#include "tests/support/TemporaryFolder.h"

#include <optional>
#include <string>
#include <vector>

namespace penumbra {

/// How a run of the program ended.
struct Outcome {
    int exitCode = -1; ///< -1: it was killed, by a signal or by the time limit
    std::string out;   ///< standard output
    std::string err;   ///< standard error
};

struct RunLimits {
    std::optional<std::size_t> fileBytes = {};    ///< no file may grow beyond this: a full disk
    std::optional<std::size_t> addressBytes = {}; ///< as `ulimit -v`
    unsigned seconds = 280;                       ///< then it is killed: it may wait for ever
    unsigned cpuSeconds = 60;                     ///< then it is killed
    bool childrenIgnored = false;         ///< SIGCHLD is, as some who start programs have it
    std::string endWhenItWritesInto = {}; ///< gets SIGTERM when it creates a file in this folder
};

/// Runs penumbra with these arguments and waits for its end.
Outcome runPenumbra(const std::vector<std::string>& arguments, const RunLimits& limits = {});

/// A folder that lives as long as this object.
class Workplace {
public:
    /// Path of a file here, whether there is one or not.
    std::string path(const std::string& name) const { return folder_.file(name); }
    /// Writes a file and returns its path.
    std::string write(const std::string& name, const std::string& text) const;
    /// Names of all files, sorted.
    std::vector<std::string> files() const;

private:
    TemporaryFolder folder_;
};

std::string readFile(const std::string& path);
std::size_t lineCount(const std::string& text);

/// A small room in USD text: walls, a box, a light and a camera.
std::string smallRoom();
/// A layer with one mesh, whose attributes are given as text, and a light above it.
std::string meshUnderLight(const std::string& attributes);
/// Options that keep solving below a second.
std::vector<std::string> coarse();

} // namespace penumbra
