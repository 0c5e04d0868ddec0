// The recording of a session, safe on disk.
#pragma once

#include "io/usd/recording/UsdRecording.h"

#include <optional>
#include <string>

namespace penumbra {

class Walkthrough;

/// A UsdRecording that is written now and then, and at the end whatever ends it: what was recorded
/// is lost by a few seconds at worst, also when the program is killed.
class SessionFile {
public:
    static constexpr double kSaveSeconds = 3;

    /// Begins, and writes the layer at once. \throws Error if it can't be written
    SessionFile(const Walkthrough& walk, const std::string& scene, std::string layer);
    /// As finish(), if that was not called; a failure is one line to standard error.
    ~SessionFile();
    SessionFile(const SessionFile&) = delete;
    SessionFile& operator=(const SessionFile&) = delete;

    /// To be called once a frame, after all edits. \return why it couldn't be written now, once
    /// every kSaveSeconds; nothing is lost, it is tried again
    std::optional<std::string> take(const Walkthrough& walk);
    /// Writes what has not been written. \throws Error if it can't be written
    void finish();

    const std::string& layer() const { return layer_; }

private:
    void sample(const Walkthrough& walk);

    UsdRecording recording_;
    std::string layer_;
    double start_ = 0, tried_ = 0; ///< of the walkthrough's time [s]
    bool unsaved_ = false;
};

} // namespace penumbra
