// Indirect light and its detail, at the scenes' default sizes.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "radiosity/DetailGather.h"
#include "radiosity/RayScene.h"
#include "radiosity/Solver.h"

#include <string>

namespace penumbra {

namespace {

void gather(DetailGather& detail, const Solver& solver) {
    constexpr std::size_t kEffort = std::size_t(1) << 20; // of a piece of work [rays]
    while (detail.trace(kEffort)) {
    }
    detail.beginSweeps(solver.direct().vertices(), solver.nodeIlluminance());
    while (detail.sweeping()) detail.sweep(kEffort);
}

void indirect(benchmark::State& state, const std::string& name) {
    const BenchScene scene(name);
    for (auto _ : state) {
        resetPeakMemory();
        const BuiltPatches built = scene.mesh(0);
        const RayScene rays(built.patches.rayMeshes);
        Solver solver(built.patches, rays, {.detail = false});
        solver.settle();
        const double seconds = solver.statistics().indirect.seconds;
        state.SetIterationTime(seconds);

        RowSize size;
        for (const Row& row : solver.patchRows()) {
            const RowSize one = sizeOf(row);
            size.entries += one.entries;
            size.bytes += one.bytes;
        }
        const SolveStatistics statistics = solver.statistics();
        auto& counters = state.counters;
        const Stopwatch detailing;
        DetailGather detail(built.patches);
        gather(detail, solver);
        counters["detail_s"] = detailing.wall();
        counters["detail_cpu_s"] = detailing.cpu();
        counters["detail_rays"] = double(detail.hits().rayCount());
        counters["patches"] = double(built.patches.patches.size());
        counters["nodes"] = double(built.patches.nodes.size());
        counters["elements"] = double(built.patches.elements.size());
        counters["shots"] = double(statistics.shots);
        counters["indirect_s"] = seconds;
        counters["rays"] = double(statistics.indirect.rays.total());
        counters["Mrays_per_s"] = double(statistics.indirect.rays.total()) * 1e-6 / seconds;
        counters["entries"] = double(size.entries);
        counters["bytes_per_entry"] = double(size.bytes) / double(size.entries);
        counters["rows_MB"] = double(size.bytes) * 1e-6;
        counters["peak_MB"] = peakMemory() * 1e-6;
    }
}

const bool registered = [] {
    for (const std::string name : {"chamber", "office", "gallery"})
        addCase("indirect/" + name, benchmark::kSecond, indirect, name);
    return true;
}();

} // namespace

} // namespace penumbra
