// The time that passes.
#pragma once

#include <chrono>

namespace penumbra {

/// Of a steady clock, from some time on [s].
inline double steadySeconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

} // namespace penumbra
