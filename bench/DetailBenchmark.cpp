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

/// Those of nodes, and of vertices.
struct Hits {
    NodeHits nodes;
    DetailHits vertices;

    Hits(const PatchSet& patches, const RayScene& rays)
        : nodes(patches, rays), vertices(patches, nodes) {}
    void apply(const SceneChange& change) { vertices.apply(change, nodes.apply(change)); }
    /// \return wall [s]
    double trace() {
        const Stopwatch watch;
        while (nodes.work(kEffort) || vertices.work(kEffort)) {
        }
        return watch.wall();
    }
    std::uint64_t rays() const { return nodes.count().rays + vertices.count().rays; }
    std::uint64_t groups() const { return nodes.count().groups + vertices.count().groups; }
};

void detail(benchmark::State& state, const Move& move) {
    using Pose = MovedScene::Pose;
    for (auto _ : state) {
        MovedScene scene(move);
        scene.put(Pose::there);
        LitScene lit(scene.placed(), meshingOf(scene.asked(), 0), {.directOnly = true});
        auto& counters = state.counters;
        Hits hits(lit.patches(), lit.rays());
        counters["scratch_s"] = hits.trace();
        const std::uint64_t scratch = hits.rays();
        // There and back first, for the boxes of what is seen grow.
        for (Pose place : {Pose::home, Pose::there, Pose::home}) {
            scene.put(place);
            hits.apply(lit.follow(scene.placed()).change);
            hits.trace();
        }
        const std::uint64_t rays = hits.rays(), groups = hits.groups();
        scene.put(Pose::there);
        const SceneChange change = lit.follow(scene.placed()).change;
        const Stopwatch applying;
        hits.apply(change);
        counters["apply_s"] = applying.wall();
        const double seconds = hits.trace();
        counters["elements"] = double(lit.patches().elements.size());
        counters["nodes"] = double(lit.patches().nodes.size());
        counters["gatherers"] = double(hits.vertices.vertexCount());
        counters["scratch_rays"] = double(scratch);
        counters["update_s"] = seconds;
        counters["update_rays"] = double(hits.rays() - rays);
        counters["ray_ratio"] = double(scratch) / double(hits.rays() - rays);
        counters["groups_visited"] = double(hits.groups() - groups);
        counters["groups"] = double(hits.nodes.groupCount() + hits.vertices.groupCount());
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
