// Being asked to end.
#pragma once

#include <csignal>

namespace penumbra {

/// Turns SIGINT, SIGTERM and SIGHUP into a question that the main loop asks, for as long as this
/// lives. To be made before any thread is started: threads inherit what is blocked.
class Signals {
public:
    /// \throws Error if the system gives no descriptor
    Signals();
    ~Signals();
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    /// Whether one of them has come since this was made.
    bool endWanted();

private:
    sigset_t before_;
    int descriptor_ = -1;
    bool wanted_ = false;
};

} // namespace penumbra
