// How far long work has come.
#pragma once

#include <functional>

namespace penumbra {

/// Called now and then with the phase's name and the share done in [0, 1].
using Progress = std::function<void(const char* phase, double done)>;

/// Of a part of a phase, which is from ... to of it: the share done of the part becomes one of the
/// whole. \param progress may be empty; else it must outlive what is returned
inline Progress shareOf(const Progress& progress, double from, double to) {
    if (!progress) return {};
    return [&progress, from, to](const char* phase, double done) {
        progress(phase, from + done * (to - from));
    };
}

} // namespace penumbra
