// Rays for fine shadows of indirect light: those of a moved object against those of everything.
#include "bench/BenchScene.h"
#include "bench/MovedScene.h"
#include "radiosity/transport/DetailHits.h"
#include "radiosity/transport/LitScene.h"

#include <benchmark/benchmark.h>

#include <string>

namespace penumbra {

namespace {

constexpr std::size_t kEffort = std::size_t(1) << 20; ///< of a piece of work [rays]

/// \return wall [s]
double trace(DetailHits& hits) {
    const Stopwatch watch;
    while (hits.work(kEffort)) {
    }
    return watch.wall();
}

void detail(benchmark::State& state, const Move& move) {
    using Pose = MovedScene::Pose;
    for (auto _ : state) {
        MovedScene scene(move);
        scene.put(Pose::there);
        LitScene lit(scene.placed(), meshingOf(scene.asked(), 0), {.directOnly = true});
        auto& counters = state.counters;
        DetailHits hits(lit.patches());
        counters["scratch_s"] = trace(hits);
        const std::uint64_t scratch = hits.rayCount();
        // There and back first, for the boxes of what is seen grow.
        for (Pose place : {Pose::home, Pose::there, Pose::home}) {
            scene.put(place);
            hits.apply(lit.follow(scene.placed()).change);
            trace(hits);
        }
        const std::uint64_t rays = hits.rayCount(), groups = hits.groupsVisited();
        scene.put(Pose::there);
        const SceneChange change = lit.follow(scene.placed()).change;
        const Stopwatch applying;
        hits.apply(change);
        counters["apply_s"] = applying.wall();
        const double seconds = trace(hits);
        counters["elements"] = double(lit.patches().elements.size());
        counters["nodes"] = double(lit.patches().nodes.size());
        counters["gatherers"] = double(hits.vertexCount());
        counters["scratch_rays"] = double(scratch);
        counters["update_s"] = seconds;
        counters["update_rays"] = double(hits.rayCount() - rays);
        counters["ray_ratio"] = double(scratch) / double(hits.rayCount() - rays);
        counters["groups_visited"] = double(hits.groupsVisited() - groups);
        counters["groups"] =
            double(hits.groupCount() + lit.patches().nodes.size() / DetailHits::kGroup);
        state.SetIterationTime(seconds);
    }
}

const bool registered = [] {
    for (const Move& move : kMoves)
        benchmark::RegisterBenchmark(("edit/detail/" + std::string(move.name)).c_str(), detail,
                                     move)
            ->UseManualTime()
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace

} // namespace penumbra
