// Progress of long work, for people.
#pragma once

#include <mutex>
#include <string>

namespace penumbra {

/// A bar on standard error, redrawn at most ten times a second; silent unless standard error is a
/// terminal or it was asked for. Several threads may report progress.
class ProgressBar {
public:
    enum class When { terminal, always, never };
    explicit ProgressBar(When when);
    ~ProgressBar();

    /// \param done share of the phase, in [0, 1]
    void show(const std::string& phase, double done);
    /// Takes the bar off the screen, so that something else can be printed.
    void clear();

private:
    std::mutex guard_;
    bool on_;
    bool shown_ = false;
    double lastShown_ = 0;
    std::string phase_;
};

} // namespace penumbra
