// What a scheduling policy costs until all is settled: direct light after a move, as the lighting
// process works it off, turn by turn, with the policies plain, bound, and importance.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/MoveRun.h"
#include "importance/Gaze.h"
#include "importance/Viewpoint.h"

#include <array>
#include <string>

namespace penumbra {

namespace {

struct Size {
    const char* move;
    const char* name;
    float elementSize; ///< [m]
};
constexpr Size kSizes[] = {
    {"office/seat", "50k", 0.1f},
    {"office/seat", "100k", 0.0674f},
    {"office/seat", "1M", 0.0185f},
    {"gallery/sculpture", "100k", 0.205f},
};
constexpr double kAging = 6; ///< moves are repeated for about this long [s]
constexpr std::size_t kLeastMoves = 3, kMostMoves = 100;
constexpr double kTurn = 8e-3; ///< of the lighting process [s]

enum Policy { plain, bound, importance, kPolicies };

/// Keeps the scene of a Move lit under a policy.
class Run {
public:
    Run(const Move& move, float elementSize, Policy policy)
        : scene_(move), policy_(policy),
          lit_(scene_.placed(), meshingOf(scene_.asked(), elementSize), {.directOnly = true}) {
        if (policy == plain) lit_.solver().setPolicy(PolicyKind::plain);
        lit_.solver().settle();
    }

    struct Cost {
        double wall, cpu, rays;
    };
    /// Moves, and works it off.
    Cost go(MovedScene::Pose cluster) {
        scene_.put(cluster);
        const PlacedScene placed = scene_.placed();
        Solver& solver = lit_.solver();
        const double before = solver.done().inRays();
        const LitScene::Followed followed = lit_.follow(placed);
        const Stopwatch watch;
        if (policy_ == importance) solver.attend(attention(placed, followed.change.objects));
        while (!solver.step(kTurn)) {
        }
        return {watch.wall(), watch.cpu(), solver.done().inRays() - before};
    }
    std::size_t elements() const { return lit_.patches().elements.size(); }

private:
    /// Through the scene's first camera.
    Attention attention(const PlacedScene& placed, std::span<const ObjectId> objects) const {
        const Placed<Camera>& camera = placed.cameras.front();
        const View view = makeView(camera.node->lens(), camera.toWorld, 1280, 720);
        const Viewpoint viewpoint(view, 1280, 720);
        Bounds moved;
        for (const ObjectId object : objects) moved.add(boundsOf(lit_.patches(), object));
        GazeHints hints;
        hints.dragged = glm::dvec3(moved.centre());
        return {viewpoint, Gaze(viewpoint, hints), 20, moved, {}};
    }

    MovedScene scene_;
    Policy policy_;
    LitScene lit_;
};

/// Orders take turns, so that what else the machine does befalls all of them.
void settle(benchmark::State& state, const Move& move, float elementSize) {
    using Pose = MovedScene::Pose;
    for (auto _ : state) {
        std::array<Run, kPolicies> runs{Run(move, elementSize, plain),
                                        Run(move, elementSize, bound),
                                        Run(move, elementSize, importance)};
        std::array<std::vector<double>, kPolicies> wall, cpu, rays;
        const auto go = [&](Pose cluster) {
            for (std::size_t o = 0; o < kPolicies; ++o) {
                const Run::Cost cost = runs[o].go(cluster);
                wall[o].push_back(cost.wall), cpu[o].push_back(cost.cpu);
                rays[o].push_back(cost.rays);
            }
        };
        const Stopwatch moving;
        while (wall[plain].size() < 2 * kLeastMoves ||
               (moving.wall() < kAging && wall[plain].size() < 2 * kMostMoves)) {
            go(Pose::there);
            go(Pose::home);
        }
        const auto ratio = [](const std::vector<double>& a, const std::vector<double>& b) {
            return median(a) / median(b);
        };
        report(state, {{"elements", double(runs[plain].elements())},
                       {"plain_ms", 1e3 * median(wall[plain])},
                       {"bound_ms", 1e3 * median(wall[bound])},
                       {"importance_ms", 1e3 * median(wall[importance])},
                       {"bound_time", ratio(wall[bound], wall[plain])},
                       {"importance_time", ratio(wall[importance], wall[plain])},
                       {"bound_time_cpu", ratio(cpu[bound], cpu[plain])},
                       {"importance_time_cpu", ratio(cpu[importance], cpu[plain])},
                       {"plain_rays", median(rays[plain])},
                       {"bound_rays", ratio(rays[bound], rays[plain])},
                       {"importance_rays", ratio(rays[importance], rays[plain])},
                       {"moves", double(wall[plain].size())}});
        state.SetIterationTime(median(wall[importance]));
    }
}

const bool registered = [] {
    for (const Size& size : kSizes)
        for (const Move& move : kMoves)
            if (std::string(move.name) == size.move)
                addCase("settle/" + std::string(size.move) + "/" + size.name,
                        benchmark::kMillisecond, settle, move, size.elementSize);
    return true;
}();

} // namespace

} // namespace penumbra
