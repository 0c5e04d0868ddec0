// Direct light from scratch: chamber, office and gallery at 10 k, 100 k and 1 M elements; and a
// scene of one's own at the default sizes, the file that PENUMBRA_BENCH_SCENE names.
#include "bench/BareTracing.h"
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/PeakMemory.h"
#include "radiosity/rays/RayScene.h"
#include "radiosity/transport/Solver.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

namespace penumbra {

namespace {

/// Elements are about area / size^2, but no fewer than the scene has polygons; the gallery's
/// curved surfaces keep it above 30 k. The counter `elements` says how many there were.
struct Case {
    const char* scene;
    const char* name;
    float elementSize; ///< [m]
};
constexpr Case kCases[] = {
    {"chamber", "10k", 0.12f},  {"chamber", "100k", 0.0327f}, {"chamber", "1M", 0.01035f},
    {"office", "10k", 0.4f},    {"office", "100k", 0.0674f},  {"office", "1M", 0.0185f},
    {"gallery", "10k", 0.568f}, {"gallery", "100k", 0.205f},  {"gallery", "1M", 0.0475f},
};
/// Short cases are repeated for about this long and their best time is taken [s].
constexpr double kLongest = 2;
constexpr int kMostRounds = 20;

/// Best times of the solver and of its rays alone, taken in turns.
struct Best {
    double direct = 1e30, directCpu = 1e30;
    double rayScene = 1e30, rayCpu = 1e30, embree = 1e30, embreeCpu = 1e30;
    double seconds = 0; ///< spent on the whole
    int rounds = 0;

    void solved(const Stopwatch& watch) {
        direct = std::min(direct, watch.wall());
        directCpu = std::min(directCpu, watch.cpu());
    }
    void traced(const BareTracing::Seconds& bare) {
        rayScene = std::min(rayScene, bare.rayScene);
        rayCpu = std::min(rayCpu, bare.rayCpu);
        embree = std::min(embree, bare.embree);
        embreeCpu = std::min(embreeCpu, bare.embreeCpu);
        ++rounds;
    }
};

struct Sizes {
    RowSize rows;
    double peak = 0; ///< [bytes]
    std::uint64_t rays = 0;
};

void solveOnce(const PatchSet& patches, const RayScene& rays, const SolverOptions& options,
               Best& best, Sizes& sizes) {
    Solver solver(patches, rays, options);
    const Stopwatch watch;
    solver.settle();
    best.solved(watch);
    if (best.rounds > 0) return;
    for (const Row& row : solver.emitterRows()) {
        const RowSize size = sizeOf(row);
        sizes.rows.entries += size.entries;
        sizes.rows.bytes += size.bytes;
    }
    sizes.rays = solver.statistics().direct.rays.total();
    sizes.peak = peakMemory();
}

void report(benchmark::State& state, const PatchSet& patches, const Best& best,
            const Sizes& sizes) {
    const double elements = double(patches.elements.size());
    const double pairs = elements * double(patches.emitters.size());
    auto& counters = state.counters;
    counters["elements"] = elements;
    counters["receivers"] = double(patches.vertices.size());
    counters["lamps"] = double(patches.emitters.size());
    counters["direct_s"] = best.direct;
    counters["direct_cpu_s"] = best.directCpu;
    counters["rays"] = double(sizes.rays);
    counters["Mrays_per_s"] = double(sizes.rays) * 1e-6 / best.direct;
    counters["entries"] = double(sizes.rows.entries);
    counters["bytes_per_entry"] = double(sizes.rows.bytes) / double(sizes.rows.entries);
    counters["peak_MB"] = sizes.peak * 1e-6;
    counters["bare_s"] = best.rayScene;
    counters["bare_embree_s"] = best.embree;
    counters["direct_over_bare"] = best.direct / best.rayScene;
    counters["direct_over_bare_cpu"] = best.directCpu / best.rayCpu;
    counters["direct_over_bare_embree"] = best.direct / best.embree;
    counters["direct_over_bare_embree_cpu"] = best.directCpu / best.embreeCpu;
    // By processor time, which other programs on the machine disturb less.
    counters["outside_embree_share"] = 1 - best.embreeCpu / best.directCpu;
    counters["cpu_ns_per_element_lamp"] = 1e9 * best.directCpu / pairs;
    counters["row_bytes_per_element_lamp"] = double(sizes.rows.bytes) / pairs;
    counters["peak_bytes_per_element_lamp"] = sizes.peak / pairs;
    counters["rounds"] = best.rounds;
}

void direct(benchmark::State& state, const Case& which) {
    const BenchScene scene(which.scene);
    SolverOptions options;
    options.directOnly = true;
    for (auto _ : state) {
        resetPeakMemory();
        Best best;
        Sizes sizes;
        const Stopwatch meshing;
        const BuiltPatches built = scene.mesh(which.elementSize);
        state.counters["mesh_s"] = meshing.wall();
        const Stopwatch building;
        const RayScene rays(built.patches.rayMeshes);
        state.counters["ray_scene_s"] = building.wall();
        std::optional<BareTracing> bare;
        const Stopwatch all;
        do {
            solveOnce(built.patches, rays, options, best, sizes);
            if (!bare) bare.emplace(built.patches, rays, options);
            const BareTracing::Seconds traced = bare->measure();
            if (traced.rays != sizes.rays) return state.SkipWithError("not the solver's rays");
            best.traced(traced);
        } while (all.wall() < kLongest && best.rounds < kMostRounds);
        state.SetIterationTime(best.direct);
        report(state, built.patches, best, sizes);
    }
}

const bool registered = [] {
    for (const Case& which : kCases)
        addCase(std::string("direct/") + which.scene + "/" + which.name, benchmark::kSecond, direct,
                which);
    if (const char* const file = std::getenv("PENUMBRA_BENCH_SCENE"))
        addCase("direct/own/default", benchmark::kSecond, direct, Case{file, "default", 0});
    return true;
}();

} // namespace

} // namespace penumbra
