#include "base/MemoryError.h"

#include <thread>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace penumbra {

MemoryError::MemoryError(const std::string& forWhat)
    : Error("memory is short: " + forWhat +
            " (allow more: ulimit -v; or choose a larger --patch-size and --element-size)") {}

void requireAddressSpace(std::size_t bytes, const std::string& forWhat) {
    void* const some =
        mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (some == MAP_FAILED)
        throw MemoryError(forWhat + " needs about " + std::to_string((bytes >> 20) + 1) + " MB");
    munmap(some, bytes);
}

// Measured on two cores, as VmPeak of `penumbra render` of pictures of 64 to 2048 pixels a side
// with a `ulimit -v` of 8 GB, less that of `penumbra solve`: 415 MB, and 380 bytes a pixel.
void requireMemoryToDraw(std::size_t pixels) {
    constexpr std::size_t kMega = 1 << 20;
    constexpr std::size_t kLibraries = 400 * kMega; // Mesa, LLVM, and the code that it makes
    constexpr std::size_t kThread = 8 * kMega;      // a stack; there is one thread a core, and more
    constexpr std::size_t kPixel = 400;             // all targets, and what is read back
    const std::size_t threads = std::thread::hardware_concurrency() + 6;
    requireAddressSpace(kLibraries + threads * kThread + pixels * kPixel, "drawing by OpenGL");
}

void spareAddressSpaceIfLimited() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        mallopt(M_ARENA_MAX, 1);
}

} // namespace penumbra
