// How long dirty blocks of direct light wait at most while something is dragged without end: what
// nobody sees must have its turn as well (DirtySet::setAging()).
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "bench/MovedScene.h"
#include "radiosity/process/EditPace.h"
#include "radiosity/process/ViewerAttention.h"
#include "radiosity/transport/LitScene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

namespace penumbra {

namespace {

constexpr double kDrag = 20;        ///< [s]
constexpr double kFrame = 1.0 / 60; ///< an edit a frame, as the viewer makes them [s]
constexpr double kTurn = 8e-3; ///< of the lighting process, between two readings of the clock [s]

/// From the clock by which work waits, DirtySet::taken(), to the one on the wall.
class WorkClock {
public:
    void note(double taken, double seconds, bool idle) {
        if (notes_.empty() || notes_.back().taken < taken)
            notes_.push_back({taken, seconds});
        else if (idle)
            notes_.back().seconds = seconds; // what comes now waits from now on
    }
    /// When work was queued that was so at `taken`, at the earliest. \pre asked in rising order
    double when(double taken) {
        while (notes_.size() > 1 && notes_[1].taken <= taken) notes_.pop_front();
        return notes_.front().seconds;
    }

private:
    struct Note {
        double taken, seconds;
    };
    std::deque<Note> notes_;
};

/// Keeps a scene lit as a LightingWorker does, and watches the oldest dirty block.
class Drag {
public:
    /// \param turn of the viewer away from the scene's first camera [degrees]
    Drag(const Move& move, float elementSize, double turn)
        : scene_(move), lit_(scene_.placed(), meshingOf(scene_.asked(), elementSize), {}) {
        const PlacedScene placed = scene_.placed();
        const Placed<Camera>& camera = placed.cameras.front();
        glm::dvec3 up(0);
        up[int(scene_.scene().upAxis)] = 1;
        viewer_.setCamera(
            turned(makeView(camera.node->lens(), camera.toWorld, 1280, 720), up, turn));
        lit_.solver().settle();
    }

    void run() {
        watch_ = Stopwatch(); // meshing and the first light are not counted
        const double before = lit_.solver().direct().updates().dirty().taken();
        while (watch_.wall() < kDrag) {
            if (done_ || pace_.mayTake(watch_.wall())) edit();
            const double end = kFrame * std::ceil((watch_.wall() + 1e-3) / kFrame);
            work(end);
        }
        raysPerSecond = (lit_.solver().direct().updates().dirty().taken() - before) / kDrag;
    }

    double longest = 0, longestRays = 0; ///< [s], [rays]
    double idle = 0;                     ///< share of the time in which nothing was dirty
    double raysPerSecond = 0;
    std::size_t edits = 0;

private:
    /// There and back again, once in two seconds.
    void edit() {
        pace_.taken(watch_.wall());
        done_ = false;
        scene_.putBetween(0.5 - 0.5 * std::cos(std::numbers::pi * watch_.wall()));
        const LitScene::Followed followed = lit_.follow(scene_.placed());
        Bounds moved;
        for (const ObjectId object : followed.change.objects)
            moved.add(boundsOf(lit_.patches(), object));
        viewer_.setMoved(moved);
        viewer_.update(lit_.solver(), watch_.wall());
        ++edits;
    }
    void work(double end) {
        Solver& solver = lit_.solver();
        for (double left = end - watch_.wall(); left > 0; left = end - watch_.wall()) {
            done_ = solver.stepUntil(SolutionState::certified, std::min(kTurn, left));
            pace_.worked(watch_.wall(), solver.direct().dirtyKnown());
            look();
            if (!done_) continue;
            idle += std::max(0.0, end - watch_.wall()) / kDrag;
            std::this_thread::sleep_for(std::chrono::duration<double>(end - watch_.wall()));
        }
    }
    void look() {
        const DirtySet& dirty = lit_.solver().direct().updates().dirty();
        const std::optional<double> oldest = dirty.oldest();
        clock_.note(dirty.taken(), watch_.wall(), !oldest);
        if (!oldest) return;
        longest = std::max(longest, watch_.wall() - clock_.when(*oldest));
        longestRays = std::max(longestRays, dirty.taken() - *oldest);
    }

    MovedScene scene_;
    LitScene lit_;
    ViewerAttention viewer_;
    WorkClock clock_;
    EditPace pace_;
    bool done_ = true; ///< nothing is left to be done but what is deferred
    Stopwatch watch_;
};

void wait(benchmark::State& state, const Move& move, float elementSize, double turn) {
    for (auto _ : state) {
        Drag drag(move, elementSize, turn);
        drag.run();
        report(state, {{"longest_wait_ms", 1e3 * drag.longest},
                       {"longest_wait_rays", drag.longestRays},
                       {"rays_a_second", drag.raysPerSecond},
                       {"idle_share", drag.idle},
                       {"edits", double(drag.edits)}});
        state.SetIterationTime(drag.longest);
    }
}

const bool registered = [] {
    const struct {
        const char* name;
        float elementSize; ///< [m]
    } sizes[] = {{"50k", 0.1f}, {"100k", 0.0674f}, {"1M", 0.0185f}};
    for (const auto& size : sizes)
        for (const double turn : {0.0, 120.0})
            addCase("order/wait/office/seat/" + std::string(size.name) +
                        (turn == 0 ? "/seen" : "/turned-away"),
                    benchmark::kMillisecond, wait, kMoves[0], size.elementSize, turn);
    return true;
}();

} // namespace

} // namespace penumbra
