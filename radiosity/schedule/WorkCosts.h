// What pieces of work cost: the one cost model of the scheduler.
#pragma once

#include <cstddef>

/// In the time of one visibility ray that is traced with fifteen others [rays]. Priorities, the
/// size of pieces and aging count in it; none of it changes what comes out. Measured by
///
///     build/release/penumbra_bench --benchmark_filter=work_cost
///
/// which prints each beside the constant (row searches, sums, means and fine shadows have no case
/// there). It visits and probes blocks anywhere in a room, of which most have nothing to do with
/// the thing that moves; the constants are those of blocks that an edit concerns, with the rays
/// that they take.
namespace penumbra::cost {

/// A block of direct light, decoded and written again; and an entry that is evaluated anew, with
/// its rays.
inline constexpr std::size_t kDirectVisit = 256, kDirectEntry = 20;
/// The same, where the number of rays is known: besides these.
inline constexpr float kProbedVisit = 48, kProbedEntry = 0.5f;
/// A block of indirect light, and an entry that is evaluated anew.
inline constexpr std::size_t kIndirectVisit = 48, kIndirectEntry = 1;
/// A change probe of a block.
inline constexpr std::size_t kProbe = 100;
/// Sending a shot to a block of a row that is there, and of one that is built.
inline constexpr std::size_t kServe = 8, kBuild = 100;
/// Searching a row for dirty blocks, and each that is found.
inline constexpr std::size_t kRowSearch = 16, kRowFind = 2;
/// Summing the rows of a block of vertices, and more for each row; the mean over a patch, and more
/// for each of its elements.
inline constexpr std::size_t kSum = 16, kSumRow = 8, kMean = 16, kMeanElement = 4;
/// Taking a block from the dirty set.
inline constexpr std::size_t kTake = 4;
/// Going through a group of rays of fine shadows.
inline constexpr std::size_t kDetailVisit = 16;

} // namespace penumbra::cost
