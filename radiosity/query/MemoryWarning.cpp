#include "radiosity/query/MemoryWarning.h"

#include "base/MachineMemory.h"
#include "radiosity/rows/RowRoom.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace penumbra {

namespace {

/// What to ask for, to two digits and rather too much [GB].
std::string gigabytes(double bytes) {
    char text[32];
    const double unit = std::pow(10.0, std::floor(std::log10(std::max(bytes, 1e6))) - 1);
    std::snprintf(text, sizeof text, "%.12g", std::ceil(bytes / unit) * unit * 1e-9);
    return text;
}

/// What all rows would take, from what those take that are kept [bytes].
double bytesOfAllRows(const IndirectLight& light, const PatchSet& set) {
    std::size_t blocks = 0;
    for (const Row& row : light.rows().rows()) blocks += row.size();
    const double each = blocks > 0 ? double(light.rowBytes()) / double(blocks) : kFullBlock;
    return kRowOverhead * each * countLinks(set, light.senders());
}

} // namespace

double countLinks(const PatchSet& set, const IndirectSenders& senders) {
    constexpr std::size_t kMost = 512; // blocks that are visited
    const std::size_t blocks = set.uncoveredNodes.size() / PatchSet::kBlock;
    const std::size_t step = std::max<std::size_t>(1, blocks / kMost);
    std::size_t links = 0, visited = 0;
    for (std::size_t b = step / 2; b < blocks; b += step, ++visited) {
        Bounds box;
        for (std::size_t n = b * PatchSet::kBlock; n < (b + 1) * PatchSet::kBlock; ++n)
            if (!isPadding(set.uncoveredNodes[n])) box.add(set.uncoveredNodes[n].position);
        senders.forEachLinked(box, [&](std::uint32_t s) { links += senders.present(s); });
    }
    return visited > 0 ? double(links) * double(blocks) / double(visited) : 0;
}

std::string memoryWarning(const Solver& solver, const PatchSet& set) {
    const double budget = double(solver.memory());
    if (solver.directOnly()) {
        const double taken = double(residentMemory());
        if (taken <= budget) return {};
        return "the scene and its direct light take " + gigabytes(taken) + " GB already, of " +
               gigabytes(budget) + " GB of memory; nothing of that can be spared";
    }
    if (!solver.indirect().rowsMissing()) return {};
    const IndirectLight& light = solver.indirect();
    const double all = bytesOfAllRows(light, set);
    const double room = double(light.rowRoom());
    const double taken =
        room > 0 ? budget - kRowOverhead * room : double(residentMemory()); // by all else
    const std::string what =
        room > 0 ? "not all rows of patches are kept: of " : "no rows of patches are kept: of ";
    return what + gigabytes(budget) + " GB of memory all else takes " + gigabytes(taken) +
           " GB, and all rows would take about " + gigabytes(all) +
           " GB. What is not kept is traced again at every shot, which takes long (--memory " +
           gigabytes(taken + 1.15 * all) + ", or a larger --patch-size)";
}

} // namespace penumbra
