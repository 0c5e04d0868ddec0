#include "viewer/app/FileWatcher.h"

#include <algorithm>

namespace penumbra {

FileWatcher::FileWatcher(std::vector<std::filesystem::path> files)
    : files_(std::move(files)), known_(readTimes()), latest_(known_) {}

FileWatcher::Times FileWatcher::readTimes() const {
    Times times;
    for (const auto& file : files_) {
        std::error_code missing; // for a moment, while it is replaced
        const auto time = std::filesystem::last_write_time(file, missing);
        times.push_back(missing ? std::filesystem::file_time_type::min() : time);
    }
    return times;
}

bool FileWatcher::changed(double now) {
    if (files_.empty() || now < next_) return false;
    next_ = now + kSeconds;
    const Times times = readTimes();
    const bool resting = times == latest_;
    latest_ = times;
    const bool missing = std::any_of(times.begin(), times.end(), [](auto time) {
        return time == std::filesystem::file_time_type::min();
    });
    if (!resting || missing || times == known_) return false;
    known_ = times;
    return true;
}

} // namespace penumbra
