// Following edits of the whole solution, direct and indirect, at default sizes.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/MoveRun.h"
#include "bench/PeakMemory.h"

#include <algorithm>
#include <string>

namespace penumbra {

namespace {

/// Working tolerance: the certificate against the brightest light's exitance.
constexpr double kTolerance = 1e-4;
constexpr int kRounds = 3; ///< in each direction

/// Patches whose radiosity differs by more than 1 % of what it was.
std::size_t affected(const std::vector<Rgb>& before, const std::vector<Rgb>& after) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < before.size(); ++p)
        count += maxChannel(absolute(after[p] - before[p])) > 0.01f * maxChannel(before[p]);
    return count;
}

void reportRays(benchmark::State& state, const SolveStatistics& scratch, const MoveCost& move) {
    const RayCount& direct = move.direct.rays;
    const RayCount& indirect = move.indirect.rays;
    const double all = double(scratch.direct.rays.total() + scratch.indirect.rays.total());
    auto& counters = state.counters;
    counters["update_rays"] = double(direct.total() + indirect.total());
    counters["direct_rays"] = double(direct.total());
    counters["indirect_rays_full"] = double(indirect.full);
    counters["indirect_rays_single"] = double(indirect.single);
    counters["scratch_rays"] = all;
    counters["ray_ratio"] = all / double(direct.total() + indirect.total());
    counters["entries_changed"] = double(move.direct.entriesChanged + move.indirect.entriesChanged);
    counters["blocks_visited"] = double(move.direct.blocksVisited + move.indirect.blocksVisited);
}

/// What was deferred when the certificate was met.
void reportDeferred(benchmark::State& state, const MoveCost& move) {
    const SolveStatistics& then = move.certified;
    const auto blocks = [](const WorkCount& direct, const WorkCount& indirect) {
        return double(direct.blocksVisited + indirect.blocksVisited);
    };
    auto& counters = state.counters;
    counters["rays_until_certified"] =
        double(then.direct.rays.total() + then.indirect.rays.total());
    counters["put_off_blocks"] = double(then.dirtyBlocks);
    counters["put_off_share"] =
        double(then.dirtyBlocks) / (double(then.dirtyBlocks) + blocks(then.direct, then.indirect));
    counters["put_off_bound"] = then.dirtyBound / then.brightest;
    counters["certificate"] = then.certificate / then.brightest;
}

void reportRows(benchmark::State& state, const Solver& solver) {
    const RowSize emitters = sizeOf(solver.emitterRows()), patches = sizeOf(solver.patchRows());
    auto& counters = state.counters;
    counters["emitter_entries"] = double(emitters.entries);
    counters["emitter_bytes_per_entry"] = double(emitters.bytes) / double(emitters.entries);
    counters["patch_entries"] = double(patches.entries);
    counters["patch_bytes_per_entry"] = double(patches.bytes) / double(patches.entries);
    counters["rows_MB"] = 1e-6 * double(emitters.bytes + patches.bytes);
    counters["bytes_per_entry"] =
        double(emitters.bytes + patches.bytes) / double(emitters.entries + patches.entries);
}

void total(benchmark::State& state, const Move& move) {
    using Pose = MovedScene::Pose;
    SolverOptions options;
    options.residual = kTolerance;
    options.detail = false; // see DetailBenchmark.cpp
    for (auto _ : state) {
        resetPeakMemory();
        MoveRun run(move, {}, options);
        const SolveStatistics scratch = run.statistics();
        auto& counters = state.counters;
        counters["elements"] = double(run.lit().patches().elements.size());
        counters["patches"] = double(run.lit().patches().patchCount());
        counters["scratch_s"] = run.firstCertified();
        counters["scratch_settled_s"] = run.firstSolve().wall;
        counters["scratch_shots"] = double(scratch.shots);

        std::vector<double> wall, settled, follow, direct, indirect;
        for (int i = 0; i < kRounds; ++i) {
            const bool last = i + 1 == kRounds;
            run.go(Pose::home);
            const std::vector<Rgb> before = run.lit().solver().radiosity();
            const MoveCost cost = run.go(Pose::there);
            wall.push_back(cost.wallToCertified()), settled.push_back(cost.wall());
            follow.push_back(cost.place + cost.follow);
            direct.push_back(cost.certified.direct.seconds);
            indirect.push_back(cost.certified.indirect.seconds);
            if (!last) continue;
            counters["patches_affected"] = double(affected(before, run.lit().solver().radiosity()));
            counters["update_shots"] = double(cost.shots);
            reportRays(state, scratch, cost);
            reportDeferred(state, cost);
        }
        counters["update_s"] = median(wall);
        counters["update_settled_s"] = median(settled);
        counters["follow_s"] = median(follow);
        counters["direct_s"] = median(direct);
        counters["indirect_s"] = median(indirect);
        counters["time_ratio"] = run.firstCertified() / median(wall);
        counters["time_ratio_settled"] = run.firstSolve().wall / median(settled);
        reportRows(state, run.lit().solver());
        counters["peak_MB"] = peakMemory() * 1e-6;
        state.SetIterationTime(median(wall));
    }
}

/// The paper's continuous moves: an animation is played, every frame to the working tolerance.
void play(benchmark::State& state, const std::string& layer, bool directOnly) {
    SolverOptions options;
    options.residual = kTolerance;
    options.detail = false; // see DetailBenchmark.cpp
    options.directOnly = directOnly;
    for (auto _ : state) {
        const LoadedScene loaded = loadScene(layer);
        const Scene& scene = *loaded.scene;
        LitScene lit(placeScene(scene), meshingOf(loaded.asked, 0), options);
        const Stopwatch solving;
        lit.solver().settle();
        state.counters["scratch_s"] = solving.wall();
        std::vector<double> seconds;
        const Stopwatch playing;
        for (double time = scene.startTimeCode + 1; time <= scene.endTimeCode; ++time) {
            loaded.animation->setTime(time);
            const Stopwatch one;
            if (lit.follow(placeScene(scene)).rebuilt)
                return state.SkipWithError("meshed anew while the animation was played");
            lit.solver().settle(SolutionState::certified);
            seconds.push_back(one.wall());
        }
        const double all = playing.wall();
        auto& counters = state.counters;
        counters["patches"] = double(lit.patches().patchCount());
        counters["elements"] = double(lit.patches().elements.size());
        counters["updates"] = double(seconds.size());
        counters["updates_per_s"] = double(seconds.size()) / all;
        counters["update_s"] = median(seconds);
        counters["longest_s"] = *std::max_element(seconds.begin(), seconds.end());
        state.SetIterationTime(all);
    }
}

const bool registered = [] {
    for (const Move& move : kMoves) {
        if (std::string(move.name) == "gallery/ceiling") continue; // half a minute more
        addCase(std::string("edit/total/") + move.name, benchmark::kMillisecond, total, move);
    }
    for (const bool directOnly : {true, false})
        addCase(std::string("edit/play/chamber/") + (directOnly ? "direct" : "total"),
                benchmark::kSecond, play, "chamber-move", directOnly);
    return true;
}();

} // namespace

} // namespace penumbra
