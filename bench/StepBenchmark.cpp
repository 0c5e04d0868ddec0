// How far Solver::step() goes beyond the time that it was given, while a recorded walk is followed.
#include "bench/BenchCase.h"
#include "bench/BenchScene.h"
#include "radiosity/transport/LitScene.h"

#include <algorithm>
#include <string>
#include <vector>

namespace penumbra {

namespace {

constexpr int kEdits = 6;
constexpr std::size_t kFirst = 10; ///< steps after an edit that are reported by themselves

double largest(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}
double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// \param budget of a step [s]
void steps(benchmark::State& state, const std::string& layer, float elementSize, bool directOnly,
           double budget) {
    SolverOptions options;
    options.residual = 1e-4;
    options.directOnly = directOnly;
    for (auto _ : state) {
        const LoadedScene loaded = loadScene(layer);
        const Scene& scene = *loaded.scene;
        LitScene lit(placeScene(scene), meshingOf(loaded.asked, elementSize), options);
        lit.solver().settle();
        std::vector<double> over, first, busy; // [s]; busy: of the calling thread
        const double stride = (scene.endTimeCode - scene.startTimeCode) / kEdits;
        for (int edit = 1; edit <= kEdits; ++edit) {
            loaded.animation->setTime(scene.startTimeCode + edit * stride);
            if (lit.follow(placeScene(scene)).rebuilt)
                return state.SkipWithError("meshed anew while the animation was played");
            std::size_t count = 0;
            for (bool done = false; !done; ++count) {
                const Stopwatch one;
                done = lit.solver().step(budget);
                over.push_back(one.wall() - budget);
                busy.push_back(one.thread() - budget);
                if (count < kFirst) first.push_back(over.back());
            }
        }
        report(state, {{"elements", double(lit.patches().elements.size())},
                       {"steps", double(over.size())},
                       {"over_ms", 1e3 * largest(over)},
                       {"over_first_ms", 1e3 * largest(first)},
                       {"over_99_ms", 1e3 * percentile(over, 0.99)},
                       {"over_thread_ms", 1e3 * largest(busy)}});
        state.SetIterationTime(budget + largest(over));
    }
}

const bool registered = [] {
    for (const std::string layer : {"office-seat", "office-lamp"}) {
        addCase("edit/steps/" + layer, benchmark::kMillisecond, steps, layer, 0.0f, false, 1e-3);
        addCase("edit/steps/" + layer + "/1M", benchmark::kMillisecond, steps, layer, 0.0185f, true,
                1e-3);
    }
    return true;
}();

} // namespace

} // namespace penumbra
