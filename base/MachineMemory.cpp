#include "base/MachineMemory.h"

#include <algorithm>
#include <fstream>
#include <limits>

#include <unistd.h>

namespace penumbra {

namespace {

std::size_t pageSize() {
    return std::size_t(std::max(1l, sysconf(_SC_PAGESIZE)));
}

} // namespace

std::size_t machineMemory() {
    const long pages = sysconf(_SC_PHYS_PAGES);
    std::size_t memory = pages > 0 ? std::size_t(pages) * pageSize() : 0;
    std::size_t limit = 0; // of a container; elsewhere the file says "max", or is not there
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> limit)
        memory = memory > 0 ? std::min(memory, limit) : limit;
    return memory;
}

std::size_t residentMemory() {
    std::size_t all = 0, resident = 0; // [pages]
    return std::ifstream("/proc/self/statm") >> all >> resident ? resident * pageSize() : 0;
}

std::size_t memoryBudget(std::size_t asked) {
    if (asked > 0) return asked;
    const std::size_t memory = machineMemory();
    return memory > 0 ? memory / 2 : std::numeric_limits<std::size_t>::max();
}

} // namespace penumbra
