// Waking a worker that waits for messages.
#pragma once

#include <atomic>
#include <cstdint>

namespace penumbra {

/// Makes a waiting worker check again. Never waits. Works across processes (a futex).
void ring(std::atomic<std::uint32_t>& bell);
/// Waits until the bell is rung, if it still says `heard`, but not longer than this [s].
void waitForRing(std::atomic<std::uint32_t>& bell, std::uint32_t heard, double seconds);

} // namespace penumbra
