// Indirect light and its detail, at the scenes' default sizes.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/PeakMemory.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/transport/DetailGather.h"
#include "radiosity/transport/Solver.h"

#include <string>

namespace penumbra {

namespace {

void gather(NodeHits& nodes, DetailGather& detail, const Solver& solver) {
    constexpr std::size_t kEffort = std::size_t(1) << 20; // of a piece of work [rays]
    while (nodes.work(kEffort) || detail.trace(kEffort)) {
    }
    detail.beginSweeps(solver.direct().vertices(), solver.nodeIlluminance());
    while (detail.sweeping()) detail.sweep(kEffort);
}

struct Case {
    std::string name, scene;
    float patchSize = 0; ///< [m]; 0: the scene's
    SolverOptions solving;
};

void indirect(benchmark::State& state, const Case& what) {
    const BenchScene scene(what.scene);
    for (auto _ : state) {
        resetPeakMemory();
        const BuiltPatches built = scene.mesh(0, what.patchSize);
        const RayScene rays(built.patches.rayMeshes);
        Solver solver(built.patches, rays, what.solving);
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
        NodeHits nodes(built.patches, rays);
        DetailGather detail(built.patches, nodes);
        gather(nodes, detail, solver);
        counters["detail_s"] = detailing.wall();
        counters["detail_cpu_s"] = detailing.cpu();
        counters["detail_rays"] = double(nodes.count().rays + detail.hits().count().rays);
        counters["patches"] = double(built.patches.patches.size());
        counters["nodes"] = double(built.patches.nodes.size());
        counters["elements"] = double(built.patches.elements.size());
        counters["shots"] = double(statistics.shots);
        counters["indirect_s"] = seconds;
        counters["rays"] = double(statistics.indirect.rays.total());
        counters["Mrays_per_s"] = double(statistics.indirect.rays.total()) * 1e-6 / seconds;
        counters["certificate"] = statistics.certificate;
        counters["mean_radiosity"] = statistics.meanRadiosity;
        counters["entries"] = double(size.entries);
        counters["bytes_per_entry"] = double(size.bytes) / double(size.entries);
        counters["rows_MB"] = double(size.bytes) * 1e-6;
        counters["peak_MB"] = peakMemory() * 1e-6;
    }
}

const bool registered = [] {
    const SolverOptions clusters{.detail = false}, flat{.detail = false, .clusters = false};
    for (const Case& what : {Case{"chamber", "chamber", 0, clusters},
                             {"office", "office", 0, clusters},
                             {"office-flat", "office", 0, flat},
                             {"gallery", "gallery", 0, clusters},
                             {"gallery-flat", "gallery", 0, flat},
                             {"gallery-1M", "gallery", 0.37f, clusters}})
        addCase("indirect/" + what.name, benchmark::kSecond, indirect, what);
    return true;
}();

} // namespace

} // namespace penumbra
