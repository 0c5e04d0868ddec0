// What a busy radiosity process costs the renderer: frame times of a walk, idle against busy; and
// what update() takes while the process is stopped.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/MoveRun.h"
#include "bench/MovedScene.h"
#include "radiosity/process/ProcessLink.h"
#include "radiosity/process/RadiosityNode.h"
#include "viewer/gl/OffscreenContext.h"
#include "viewer/gl/Renderer.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include <sched.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

namespace penumbra {

namespace {

constexpr int kFrames = 60, kRounds = 3; ///< of a walk; walks of each kind, in turn
constexpr int kWidth = 640, kHeight = 360;
constexpr float kRegion = 0.25f; ///< of the scene's extent is evaluated over and over

/// All threads of a process.
void pin(pid_t process, int core) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(core, &set);
    for (const auto& task :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task"))
        sched_setaffinity(std::atoi(task.path().filename().c_str()), sizeof set, &set);
}

pid_t workerProcess() {
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
        std::ifstream list(task.path() / "children");
        if (pid_t child = 0; list >> child) return child;
    }
    return 0;
}

/// Times that this thread gave up its core of its own accord.
long waitsSoFar() {
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_nvcsw;
}

/// A share of the values is not larger.
double quantile(std::vector<double> values, double share) {
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// Of one kind of walk.
struct Times {
    std::vector<double> frames;  ///< [s]
    std::vector<double> updates; ///< RadiosityNode::update() alone [s]
    long waits = 0;              ///< in update()
};

/// The scene of a Move, lit by a process, and a renderer.
class Walk {
public:
    explicit Walk(const Move& move) : scene_(move) {
        RadiosityOptions options;
        options.meshing = meshingOf(scene_.asked(), 0);
        options.trigger = Trigger::continuous;
        options.threads = 1;
        options.niceness = 0;
        options.timeout = 600; // it may be stopped
        node_ = std::make_shared<RadiosityNode>(
            "lit", options, makeProcessLink({.program = PENUMBRA_PROGRAM, .byHand = {}}));
        node_->add(scene_.scene().root);
        root_.add(node_);
        node_->update();
        pin(workerProcess(), 1);
        while (!node_->state().reached(SolutionState::exact)) {
            node_->update();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        pin(workerProcess(), 1); // threads that it has started since
    }

    enum class Process { idle, busy, stopped };
    /// A turn on the spot, from the first camera of the scene.
    void go(Process process, Times& times) {
        const Bounds& all = node_->placed().bounds;
        const glm::vec3 middle = 0.5f * (all.lower + all.upper), half = all.upper - middle;
        const Bounds some{middle - kRegion * half, middle + kRegion * half};
        if (process == Process::stopped) kill(workerProcess(), SIGSTOP);
        for (int frame = 0; frame < kFrames; ++frame) {
            // Work without end that changes nothing, so that all kinds of walk draw the same.
            const bool settled = node_->state().reached(SolutionState::certified);
            if (process == Process::stopped || (process == Process::busy && settled))
                node_->invalidate(some);
            const Stopwatch watch;
            const long before = waitsSoFar();
            node_->update();
            times.waits += waitsSoFar() - before;
            times.updates.push_back(watch.wall());
            renderFrame(context_, renderer_, root_, look(frame), kWidth, kHeight);
            times.frames.push_back(watch.wall());
        }
        if (process == Process::stopped) kill(workerProcess(), SIGCONT);
        while (!node_->state().reached(SolutionState::exact)) node_->update();
    }
    unsigned restarts() const { return node_->state().restarts; }

private:
    View look(int frame) const {
        const auto& camera = node_->placed().cameras.front();
        const double turn = 2 * std::numbers::pi * frame / kFrames;
        return makeView(camera.node->lens(),
                        camera.toWorld * glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0, 1, 0)),
                        kWidth, kHeight);
    }

    MovedScene scene_;
    std::shared_ptr<RadiosityNode> node_;
    Group root_{""};
    OffscreenContext context_;
    Renderer renderer_;
};

void frameTimes(benchmark::State& state, const Move& move) {
    for (auto _ : state) {
        pin(getpid(), 0);
        Walk walk(move);
        pin(getpid(), 0); // the driver's threads as well
        Times warmingUp, idle, busy, stopped;
        walk.go(Walk::Process::idle, warmingUp);
        for (int round = 0; round < kRounds; ++round) {
            walk.go(Walk::Process::idle, idle);
            walk.go(Walk::Process::busy, busy);
        }
        walk.go(Walk::Process::stopped, stopped);
        if (walk.restarts() > 0) return state.SkipWithError("the process had to be replaced");
        const auto ms = [](const std::vector<double>& times, double share) {
            return 1e3 * quantile(times, share);
        };
        report(state, {{"idle_ms", ms(idle.frames, 0.5)},
                       {"busy_ms", ms(busy.frames, 0.5)},
                       {"median_ratio", ms(busy.frames, 0.5) / ms(idle.frames, 0.5)},
                       {"idle_99_ms", ms(idle.frames, 0.99)},
                       {"busy_99_ms", ms(busy.frames, 0.99)},
                       {"ratio_99", ms(busy.frames, 0.99) / ms(idle.frames, 0.99)},
                       {"update_busy_99_ms", ms(busy.updates, 0.99)},
                       {"update_busy_longest_ms", ms(busy.updates, 1)},
                       {"update_stopped_longest_ms", ms(stopped.updates, 1)},
                       {"update_waits", double(idle.waits + busy.waits + stopped.waits)}});
        state.SetIterationTime(quantile(busy.frames, 0.5));
    }
}

const bool registered = [] {
    for (const Move& move : {kMoves[0], kMoves[3]})
        addCase("frames/" + std::string(move.name), benchmark::kMillisecond, frameTimes, move);
    return true;
}();

} // namespace

} // namespace penumbra
