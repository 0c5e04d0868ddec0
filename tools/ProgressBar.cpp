#include "tools/ProgressBar.h"

#include "base/Clock.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace penumbra {

ProgressBar::ProgressBar(When when)
    : on_(when == When::always || (when == When::terminal && isatty(STDERR_FILENO))) {}

ProgressBar::~ProgressBar() {
    clear();
}

void ProgressBar::show(const std::string& phase, double done) {
    if (!on_) return;
    const double now = steadySeconds();
    const std::lock_guard lock(guard_);
    if (phase == phase_ && now - lastShown_ < 0.1) return;
    phase_ = phase;
    lastShown_ = now;
    constexpr int kWidth = 40;
    const int filled = int(std::clamp(done, 0.0, 1.0) * kWidth);
    const std::string bar =
        std::string(std::size_t(filled), '#') + std::string(std::size_t(kWidth - filled), '.');
    std::fprintf(stderr, "\r%-16s [%s] %3d %%", phase.c_str(), bar.c_str(),
                 int(100 * std::clamp(done, 0.0, 1.0)));
    std::fflush(stderr);
    shown_ = true;
}

void ProgressBar::clear() {
    const std::lock_guard lock(guard_);
    if (!shown_) return;
    std::fprintf(stderr, "\r%*s\r", 72, "");
    shown_ = false;
}

} // namespace penumbra
