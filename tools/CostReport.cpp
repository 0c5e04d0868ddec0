#include "tools/CostReport.h"

#include "base/Error.h"
#include "base/Parallel.h"
#include "radiosity/query/CostEstimate.h"
#include "radiosity/transport/LitScene.h"
#include "tools/ProgressBar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <thread>

namespace penumbra {

namespace {

/// Of all threads of this process so far [s].
double processorTime() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

/// Two digits, never as a power of ten.
std::string twoDigits(double value) {
    if (!(value > 0)) return "0";
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
    return fmt::format("{:.10g}", std::round(value / unit) * unit);
}

std::string seconds(double s) {
    if (s < 120) return twoDigits(s) + " s";
    return s < 7200 ? twoDigits(s / 60) + " minutes" : twoDigits(s / 3600) + " hours";
}

std::string memory(double bytes) {
    return bytes < 1e9 ? twoDigits(bytes * 1e-6) + " MB" : twoDigits(bytes * 1e-9) + " GB";
}

/// \param before on one thread [s] \param solving of processor, by all threads [s]
void printLine(const char* what, double before, double solving, unsigned threads, double rays,
               double bytes) {
    constexpr double kIdle = 1.1; // threads wait for each other now and then
    fmt::print("  {}: about {} ({} of processor, {} thread{}), {} million rays, {}\n", what,
               seconds(before + kIdle * solving / threads), seconds(before + solving), threads,
               threads == 1 ? "" : "s", twoDigits(rays * 1e-6), memory(bytes));
}

} // namespace

void printCost(const SolveSettings& settings, const LoadedScene& loaded,
               const PlacedScene& placed) {
    const ThreadLimit limit(settings.threads);
    const RadiosityOptions resolved = resolvedOptions(settings, loaded, settings.frame);
    SolverOptions direct = resolved.solving;
    direct.directOnly = true;
    ProgressBar progress(whenToShowProgress(settings));
    std::unique_ptr<LitScene> lit;
    try {
        lit = std::make_unique<LitScene>(
            placed, sizesToLight(resolved.meshing, placed), direct, true,
            [&](const char* phase, double done) { progress.show(phase, done); });
    } catch (const Error& error) {
        progress.clear();
        throw SceneFileError({settings.scene}, error.what());
    }
    progress.clear();
    const PatchSet& set = lit->patches();
    const double before = processorTime(); // reading and meshing, which both kinds of light take
    fmt::print("  {} patches, {} elements, {} emitters\n", set.patchCount(), set.elements.size(),
               set.emitters.size());
    progress.show("tracing rays here and there", 0);
    const CostEstimate cost = estimateCost(*lit, resolved.solving);
    progress.clear();
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    const unsigned threads = settings.threads > 0 ? settings.threads : cores;
    printLine("direct light", before, cost.directSeconds, threads, cost.directRays,
              cost.directBytes);
    if (settings.solver.directOnly) return;
    printLine("all light", before, cost.allSeconds, threads,
              cost.directRays + cost.indirectRays + cost.detailRays, cost.allBytes);
    if (cost.rowsKept < 1)
        fmt::print("    {:.0f} % of the rows of patches fit into {} (--memory); all would take "
                   "{}\n",
                   100 * cost.rowsKept, memory(double(lit->solver().memory())),
                   memory(cost.rowBytes));
}

} // namespace penumbra
