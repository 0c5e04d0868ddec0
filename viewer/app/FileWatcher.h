// Noticing that somebody has saved a file again.
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

namespace penumbra {

/// Watches the times of some files. Checks at most every kSeconds, and says that they have changed
/// once they have come to rest: programs write a file in several steps.
class FileWatcher {
public:
    static constexpr double kSeconds = 0.5;

    explicit FileWatcher(std::vector<std::filesystem::path> files = {});

    /// Whether they have changed since the last yes. \param now time that only grows [s]
    bool changed(double now);

private:
    using Times = std::vector<std::filesystem::file_time_type>;
    Times readTimes() const;

    std::vector<std::filesystem::path> files_;
    Times known_, latest_;
    double next_ = 0;
};

} // namespace penumbra
