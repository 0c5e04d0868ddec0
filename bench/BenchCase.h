// How benchmarks of whole scenes are registered and what they say.
#pragma once

#include <benchmark/benchmark.h>

#include <initializer_list>
#include <string>
#include <utility>

namespace penumbra {

/// Registers a case that runs once and measures itself: it calls SetIterationTime().
template <class Run, class... Arguments>
void addCase(const std::string& name, benchmark::TimeUnit unit, Run&& run, Arguments&&... with) {
    benchmark::RegisterBenchmark(name.c_str(), std::forward<Run>(run),
                                 std::forward<Arguments>(with)...)
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(unit);
}

/// What bench/run.py makes tables of.
inline void report(benchmark::State& state,
                   std::initializer_list<std::pair<const char*, double>> figures) {
    for (const auto& [name, value] : figures) state.counters[name] = value;
}

} // namespace penumbra
