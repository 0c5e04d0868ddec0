// Following a move against solving from scratch: direct light of office and gallery at 10 k, 100 k
// and 1 M elements.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/LeastRays.h"
#include "bench/MoveRun.h"

#include <string>
#include <string_view>

namespace penumbra {

namespace {

struct Size {
    const char* scene;
    const char* name;
    float elementSize; ///< [m], as for direct light from scratch
};
constexpr Size kSizes[] = {
    {"office", "10k", 0.4f},    {"office", "100k", 0.0674f}, {"office", "1M", 0.0185f},
    {"gallery", "10k", 0.568f}, {"gallery", "100k", 0.205f}, {"gallery", "1M", 0.0475f},
};
/// Moves and solutions from scratch are each repeated for about this long [s].
constexpr double kAging = 1.5;
constexpr std::size_t kLeastMoves = 3, kMostMoves = 200, kMostSolves = 5;

/// Times of all moves in one direction; counts are the same each time.
struct Times {
    std::vector<double> wall, cpu, place, follow, settle;

    void add(const MoveCost& cost) {
        wall.push_back(cost.wall()), cpu.push_back(cost.cpu);
        place.push_back(cost.place), follow.push_back(cost.follow), settle.push_back(cost.settle);
    }
};

void reportTimes(benchmark::State& state, const Times& moves, const Times& scratch,
                 const LeastRays& least) {
    report(state, {{"update_s", median(moves.wall)},
                   {"update_cpu_s", median(moves.cpu)},
                   {"place_s", median(moves.place)},
                   {"follow_s", median(moves.follow)},
                   {"settle_s", median(moves.settle)},
                   {"scratch_s", median(scratch.wall)},
                   {"scratch_cpu_s", median(scratch.cpu)},
                   {"time_ratio", median(scratch.wall) / median(moves.wall)},
                   {"time_ratio_cpu", median(scratch.cpu) / median(moves.cpu)},
                   {"bare_s", least.wall},
                   {"bare_cpu_s", least.cpu},
                   {"update_over_bare", median(moves.wall) / least.wall},
                   {"update_over_bare_cpu", median(moves.cpu) / least.cpu},
                   {"settle_over_bare", median(moves.settle) / least.wall},
                   {"moves", double(moves.wall.size())}});
}

void reportCounts(benchmark::State& state, const MoveCost& move, const SolveStatistics& scratch,
                  const LeastRays& least) {
    const RayCount& rays = move.direct.rays;
    report(state, {{"update_rays", double(rays.total())},
                   {"update_rays_full", double(rays.full)},
                   {"update_rays_single", double(rays.single)},
                   {"scratch_rays", double(scratch.direct.rays.total())},
                   {"ray_ratio", double(scratch.direct.rays.total()) / double(rays.total())},
                   {"least_rays", double(least.total())},
                   {"rays_over_minimum", double(rays.total()) / double(least.total())},
                   {"least_own", double(least.own)},
                   {"least_uncovered", double(least.uncovered)},
                   {"least_released", double(least.released)},
                   {"least_met", double(least.met)},
                   {"least_refined", double(least.refined)},
                   {"self_rays", double(least.selfRays)},
                   {"own_entries", double(least.ownEntries)},
                   {"self_entries", double(least.selfEntries)},
                   {"entries_changed", double(move.direct.entriesChanged)},
                   {"entries", double(scratch.entries)},
                   {"bytes_per_entry", double(scratch.bytes) / double(scratch.entries)},
                   {"blocks_visited", double(move.direct.blocksVisited)}});
}

void edit(benchmark::State& state, const Move& move, float elementSize) {
    using Pose = MovedScene::Pose;
    SolverOptions options;
    options.directOnly = true;
    for (auto _ : state) {
        MoveRun run(move, {.elementSize = elementSize}, options);
        const PatchSet& patches = run.lit().patches();
        state.counters["elements"] = double(patches.elements.size());
        state.counters["lamps"] = double(patches.emitters.size());
        state.counters["mesh_s"] = run.meshing();
        state.counters["blocks"] =
            double(patches.vertices.size() / PatchSet::kBlock) * double(patches.emitters.size());
        run.go(Pose::home);

        Times scratch, moves;
        std::unique_ptr<Solver> fresh;
        const Stopwatch solving;
        const auto solve = [&] {
            const Seconds one = run.fromScratch(fresh);
            scratch.wall.push_back(one.wall), scratch.cpu.push_back(one.cpu);
        };
        do solve();
        while (solving.wall() < kAging && scratch.wall.size() < kMostSolves);
        const auto rowsOf = [&] { return run.lit().solver().emitterRows(); };
        if (const std::string at = firstDifference(fresh->emitterRows(), rowsOf()); !at.empty())
            return state.SkipWithError(("not what a new solver sees: " + at).c_str());

        const MoveCost first = run.go(Pose::there);
        moves.add(first);
        const LeastRays least = leastRays(patches, run.lit().rays(), options.samples, first.change,
                                          fresh->emitterRows(), rowsOf());
        reportCounts(state, first, fresh->statistics(), least);
        fresh.reset();
        const Stopwatch moving;
        while (moves.wall.size() < kLeastMoves ||
               (moving.wall() < kAging && moves.wall.size() < kMostMoves)) {
            run.go(Pose::home);
            moves.add(run.go(Pose::there));
        }
        reportTimes(state, moves, scratch, least);
        state.SetIterationTime(median(moves.wall));
    }
}

const bool registered = [] {
    const auto add = [](const Move& move, std::string_view only) {
        for (const Size& size : kSizes) {
            const std::string_view name(move.name);
            if (name.substr(0, name.find('/')) != size.scene) continue;
            if (!only.empty() && size.name != only) continue;
            addCase("edit/direct/" + std::string(name) + "/" + size.name, benchmark::kMillisecond,
                    edit, move, size.elementSize);
        }
    };
    for (const Move& move : kMoves) add(move, "");
    for (const Move& move : kWalls) add(move, "100k");
    return true;
}();

} // namespace

} // namespace penumbra
