#include "radiosity/process/memory/Doorbell.h"

#include <climits>
#include <cmath>
#include <ctime>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace penumbra {

namespace {

long futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value,
           const timespec* timeout) {
    return syscall(SYS_futex, &word, operation, value, timeout, nullptr, 0);
}

} // namespace

void ring(std::atomic<std::uint32_t>& bell) {
    bell.fetch_add(1, std::memory_order_release);
    futex(bell, FUTEX_WAKE, INT_MAX, nullptr);
}

void waitForRing(std::atomic<std::uint32_t>& bell, std::uint32_t heard, double seconds) {
    timespec timeout{};
    timeout.tv_sec = std::time_t(seconds);
    timeout.tv_nsec = long((seconds - std::floor(seconds)) * 1e9);
    futex(bell, FUTEX_WAIT, heard, &timeout);
}

} // namespace penumbra
