// From an edit to its light where it is drawn: by the solver alone, by a worker in a thread, and by
// one in a process.
#include "base/Parallel.h"
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/MoveRun.h"
#include "bench/MovedScene.h"
#include "radiosity/process/ProcessLink.h"
#include "radiosity/process/RadiosityNode.h"

#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace penumbra {

namespace {

using Pose = MovedScene::Pose;

constexpr int kRepeats = 8; ///< there and back, by each way in turn: drift hits all

/// A scene that is kept lit in some way, and what its moves took.
class LitMove {
public:
    virtual ~LitMove() = default;
    virtual void move(Pose place) = 0;

    std::vector<double> first;  ///< from the edit to the first block with new light [s]
    std::vector<double> settle; ///< from the edit to the settled light [s]
};

/// Without anything between solver and caller: what the others are measured by.
class AloneMove : public LitMove {
public:
    AloneMove(const Move& move, float elementSize) : scene_(move) {
        scene_.put(Pose::home);
        lit_ = std::make_unique<LitScene>(scene_.placed(), meshingOf(scene_.asked(), elementSize),
                                          SolverOptions());
        lit_->solver().settle();
        lit_->solver().takeSummedBlocks();
    }

    void move(Pose place) override {
        Solver& solver = lit_->solver();
        const Stopwatch watch;
        scene_.put(place);
        lit_->follow(scene_.placed());
        while (!solver.stepUntil(SolutionState::certified, 1e-4)) {
            solver.sumUp();
            if (!solver.takeSummedBlocks().empty()) break;
        }
        first.push_back(watch.wall());
        solver.settle(SolutionState::certified);
        settle.push_back(watch.wall());
        solver.settle(); // what was deferred is not measured
        solver.takeSummedBlocks();
    }

private:
    MovedScene scene_;
    std::unique_ptr<LitScene> lit_;
};

/// Below a RadiosityNode, as a renderer has it that draws nothing.
class NodeMove : public LitMove {
public:
    NodeMove(const Move& move, float elementSize, std::unique_ptr<LightingLink> link)
        : scene_(move) {
        scene_.put(Pose::home);
        RadiosityOptions options;
        options.meshing = meshingOf(scene_.asked(), elementSize);
        options.trigger = Trigger::continuous;
        options.threads = 1;
        options.niceness = 0;
        node_ = std::make_shared<RadiosityNode>("lit", options, std::move(link));
        node_->add(scene_.scene().root);
        do update();
        while (!node_->state().reached(SolutionState::exact));
    }

    void move(Pose place) override {
        const std::uint64_t before = node_->state().blocksTaken;
        const Stopwatch watch;
        scene_.put(place);
        do update();
        while (node_->state().blocksTaken == before && !settled());
        first.push_back(watch.wall());
        while (!settled()) update();
        settle.push_back(watch.wall());
        while (!node_->state().reached(SolutionState::exact)) update();
    }
    unsigned restarts() const { return node_->state().restarts; }

private:
    bool settled() const { return node_->state().reached(SolutionState::certified); }
    void update() {
        node_->update();
        std::this_thread::yield();
    }

    MovedScene scene_;
    std::shared_ptr<RadiosityNode> node_;
};

void latency(benchmark::State& state, const Move& move, float elementSize) {
    for (auto _ : state) {
        const ThreadLimit one(1); // as the workers: the other core is the renderer's
        AloneMove alone(move, elementSize);
        NodeMove thread(move, elementSize, makeThreadLink());
        NodeMove process(move, elementSize,
                         makeProcessLink({.program = PENUMBRA_PROGRAM, .byHand = {}}));
        for (int i = 0; i < kRepeats; ++i)
            for (LitMove* way : {static_cast<LitMove*>(&alone), static_cast<LitMove*>(&thread),
                                 static_cast<LitMove*>(&process)})
                way->move(i % 2 == 0 ? Pose::there : Pose::home);
        if (process.restarts() > 0) return state.SkipWithError("the process had to be replaced");
        const auto ms = [](const std::vector<double>& times) { return 1e3 * median(times); };
        report(state, {{"alone_first_ms", ms(alone.first)},
                       {"thread_first_ms", ms(thread.first)},
                       {"process_first_ms", ms(process.first)},
                       {"thread_first_more_ms", ms(thread.first) - ms(alone.first)},
                       {"process_first_more_ms", ms(process.first) - ms(alone.first)},
                       {"alone_settle_ms", ms(alone.settle)},
                       {"thread_settle_ms", ms(thread.settle)},
                       {"process_settle_ms", ms(process.settle)},
                       {"thread_settle_ratio", ms(thread.settle) / ms(alone.settle)},
                       {"process_settle_ratio", ms(process.settle) / ms(alone.settle)}});
        state.SetIterationTime(median(process.settle));
    }
}

const bool registered = [] {
    addCase("latency/office/seat", benchmark::kMillisecond, latency, kMoves[0], 0.0674f);
    addCase("latency/gallery/sculpture", benchmark::kMillisecond, latency, kMoves[3], 0.205f);
    return true;
}();

} // namespace

} // namespace penumbra
