#include "base/Error.h"
#include "base/Parallel.h"
#include "radiosity/mesh/Contact.h"
#include "radiosity/query/LitSurface.h"
#include "radiosity/query/PointGather.h"
#include "radiosity/rays/Margins.h"
#include "scenegraph/Objects.h"
#include "tools/Commands.h"
#include "tools/OutputFiles.h"
#include "tools/SceneSolution.h"
#include "tools/SensorFile.h"
#include "tools/Statistics.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace penumbra {

namespace {

struct SolveCommand {
    SolveSettings solve;
    std::string sensors, values;
    bool gather = false;
};

/// What the sensors read: of the drawn surface under them, or evaluated where they are. A sensor
/// with no surface under it, or on one that something else lies on so that nobody can see it, is
/// always evaluated.
std::vector<Rgb> readSensorValues(SceneSolution& solution, const std::vector<Receiver>& sensors,
                                  bool gather, bool directOnly) {
    const LitSurface surface(solution.patches(), solution.lighting());
    const PointGather point(solution.patches(), solution.rays(), solution.lighting());
    std::vector<Rgb> values(sensors.size());
    parallelFor(sensors.size(), 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const PatchSet& patches = solution.patches();
            Receiver lifted = sensors[i];
            const float hover = hoverAt(patches.skin, lifted.position);
            lifted.position += hover * lifted.normal;
            const Lie lie = lieOf(solution.rays(), patches.rayMeshes, lifted.position,
                                  lifted.normal, coverDistance(patches.elementSize, hover));
            if (lie == Lie::buried) continue; // no light gets there
            if (!gather && lie == Lie::free) {
                const auto drawn = surface.under(sensors[i].position, sensors[i].normal);
                if (drawn && patches.receives(drawn->element)) {
                    values[i] = drawn->direct + drawn->indirect;
                    continue;
                }
            }
            values[i] = point.direct(lifted);
            if (!directOnly) values[i] += point.indirect(lifted);
        }
    });
    return values;
}

void run(SolveCommand command) {
    const ThreadLimit limit(command.solve.threads);
    const std::string& frames = command.solve.frames;
    const FrameRange range = frames.empty() ? FrameRange{} : frameRange(frames);
    command.solve.outputs = everyName(command.values, range);
    command.solve.outputs.push_back(command.solve.stats);
    checkOutputs({command.solve.scene, command.sensors}, command.solve.outputs);
    std::vector<Receiver> sensors; // read first: a wrong list should not cost a solution
    if (!command.sensors.empty()) sensors = readSensors(command.sensors);
    const bool everyFrame = command.values.find('#') != std::string::npos;
    SceneSolution solution(command.solve);
    if (!command.solve.quiet && !hasLights(solution.placed()))
        fmt::print(stderr, "{}: warning: {}: all values are 0\n", command.solve.scene, kNoLights);
    for (int frame = range.first; frame <= range.last; ++frame) {
        if (frame > range.first) solution.show(frame);
        if (sensors.empty() || (!everyFrame && frame < range.last)) continue;
        const auto values = solution.timed("sensors", [&] {
            return readSensorValues(solution, sensors, command.gather,
                                    command.solve.solver.directOnly);
        });
        writeValues(numberedPath(command.values, frame), sensors, values);
    }
    if (!command.solve.stats.empty()) writeStatistics(command.solve.stats, solution);
    solution.warn();
    if (command.solve.quiet || command.values == "-") return;
    const SolveStatistics s = solution.statistics();
    const PatchSet& patches = solution.patches();
    fmt::print(stderr,
               "{} patches, {} elements, {} emitters; {:.1f} M rays, {} shots in {:.1f} s; {}\n",
               patches.patchCount(), patches.elements.size(), patches.emitters.size(),
               double(s.direct.rays.total() + s.indirect.rays.total()) * 1e-6, s.shots,
               s.direct.seconds + s.indirect.seconds, certificateSummary(s));
}

} // namespace

void addSolveCommand(CLI::App& app) {
    auto command = std::make_shared<SolveCommand>();
    CLI::App* const solve = app.add_subcommand(
        "solve", "The lighting itself: values at sensors, statistics.\n"
                 "Example: penumbra solve room.usda --sensors points.csv --values lux.csv");
    addSolveOptions(*solve, command->solve);
    CLI::Option* const sensors =
        solve->add_option("--sensors", command->sensors,
                          "CSV with the header x,y,z,nx,ny,nz (metres, scene frame, unit normal)");
    CLI::Option* const values =
        solve->add_option("--values", command->values,
                          "Where to write the sensors with r,g,b added, illuminance in lux\n"
                          "(\"-\": standard output); of the last frame, unless the name has a '#'");
    sensors->needs(values);
    values->needs(sensors);
    solve
        ->add_flag("--gather", command->gather,
                   "Evaluate light at the sensors themselves (direct light by closed form and\n"
                   "shadow rays, indirect gathered from the patches) instead of reading it off\n"
                   "the surface as drawn")
        ->needs(sensors);
    solve->callback([command] { run(*command); });
}

} // namespace penumbra
