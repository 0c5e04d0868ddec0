// How much memory a process has taken.
#pragma once

namespace penumbra {

/// Peak resident memory of this process since the last reset (Linux) [bytes].
double peakMemory();
/// Where the kernel refuses, the peak since the start of the process stays; run.py gives each case
/// a process of its own.
void resetPeakMemory();

} // namespace penumbra
