// How much memory there is, and how much of it this process takes.
#pragma once

#include <cstddef>

namespace penumbra {

/// Of the machine, or what the process may have of it where a group of processes is limited
/// (cgroup) [bytes]; 0: unknown.
std::size_t machineMemory();

/// Resident now [bytes]; 0: unknown. Memory that was freed and that the allocator keeps counts.
std::size_t residentMemory();

/// A budget for this process [bytes]: what was asked for, or if nothing was, half of the machine's
/// memory. Others are to run beside, and what a solution takes is not known to the byte.
/// \param asked 0: nothing
std::size_t memoryBudget(std::size_t asked);

} // namespace penumbra
