// The cost of an edit follows what the edit changes: the same seat is moved in buildings of 1, 4
// and 16 offices. Direct light, and all of it but for fine shadows.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/MoveRun.h"
#include "bench/PeakMemory.h"

#include <string>

namespace penumbra {

namespace {

/// About 50 k elements an office. Default sizes would follow the building's area.
constexpr MeshingOptions kMeshing{.patchSize = 0.4f, .elementSize = 0.1f};
struct Light {
    const char* name;
    bool directOnly;
    int rounds;
};
constexpr Light kDirect{"edit/building/", true, 15}, kAll{"edit/lit-building/", false, 3};

void building(benchmark::State& state, const Light& light, int copies) {
    using Pose = MovedScene::Pose;
    SolverOptions options;
    options.directOnly = light.directOnly;
    options.detail = false;
    for (auto _ : state) {
        resetPeakMemory();
        MoveRun run(kMoves[0], kMeshing, options, copies);
        const double scratchRays =
            double(run.statistics().direct.rays.total() + run.statistics().indirect.rays.total());
        std::vector<double> wall, cpu, follow;
        MoveCost cost;
        for (int i = 0; i < light.rounds; ++i) {
            run.go(Pose::home);
            cost = run.go(Pose::there);
            wall.push_back(cost.wall()), cpu.push_back(cost.cpu);
            follow.push_back(cost.place + cost.follow);
        }
        auto& counters = state.counters;
        counters["elements"] = double(run.lit().patches().elements.size());
        counters["lamps"] = double(run.lit().patches().emitters.size());
        counters["mesh_s"] = run.meshing();
        counters["scratch_s"] = run.firstSolve().wall;
        counters["scratch_rays"] = scratchRays;
        counters["update_s"] = median(wall);
        counters["update_cpu_s"] = median(cpu);
        counters["follow_s"] = median(follow);
        counters["update_rays"] = double(cost.direct.rays.total() + cost.indirect.rays.total());
        counters["update_rays_full"] = double(cost.direct.rays.full + cost.indirect.rays.full);
        counters["update_rays_single"] =
            double(cost.direct.rays.single + cost.indirect.rays.single);
        counters["entries_changed"] = double(cost.direct.entriesChanged);
        counters["blocks_visited"] = double(cost.direct.blocksVisited);
        counters["entries"] = double(run.statistics().entries);
        counters["rows_MB"] = 1e-6 * double(run.statistics().bytes);
        counters["peak_MB"] = 1e-6 * peakMemory();
        state.SetIterationTime(median(wall));
    }
}

const bool registered = [] {
    for (const Light& light : {kDirect, kAll})
        for (const int copies : {1, 4, 16})
            addCase(light.name + std::to_string(copies), benchmark::kMillisecond, building, light,
                    copies);
    return true;
}();

} // namespace

} // namespace penumbra
