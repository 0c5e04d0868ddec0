#include "base/Error.h"
#include "base/Parallel.h"
#include "comparison/ComparePolicies.h"
#include "comparison/HtmlReport.h"
#include "io/image/AtomicFile.h"
#include "tools/CameraChoice.h"
#include "tools/Commands.h"
#include "tools/ComparisonJson.h"
#include "tools/Machine.h"
#include "tools/OutputFiles.h"
#include "tools/SceneSolution.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace penumbra {

namespace {

struct CompareCommand {
    SolveSettings solve;
    std::string output, json, camera, cutFrom, policies, dirty = "shafts";
    double pan = 0;
    int width = 480, height = 0;
    double growth = 1.25;
    int filmFrame = 0;
};

/// The animation, as the comparison plays it.
Playback playbackOf(const CompareCommand& command, LoadedScene& loaded) {
    const FrameRange range = frameRange(command.solve.frames);
    if (range.first == range.last)
        throw CLI::ValidationError("--frames", "needs at least two frames: what changes from one "
                                               "to the next is what is watched");
    Playback playback;
    for (int frame = range.first; frame <= range.last; ++frame) playback.frames.push_back(frame);
    playback.show = [&loaded](double frame) {
        if (loaded.animation) loaded.animation->setTime(frame);
        return placeScene(*loaded.scene);
    };
    playback.view = [&command, &loaded](const PlacedScene& placed) {
        return viewOf(placed, loaded.scene->upAxis, command.camera, command.solve.scene,
                      command.width, command.height);
    };
    if (!command.cutFrom.empty())
        playback.viewBefore = [&command, &loaded](const PlacedScene& placed) {
            return viewOf(placed, loaded.scene->upAxis, command.cutFrom, command.solve.scene,
                          command.width, command.height);
        };
    playback.pan = command.pan;
    playback.up = glm::dvec3(0);
    playback.up[int(loaded.scene->upAxis)] = 1;
    return playback;
}

ComparisonOptions optionsOf(const CompareCommand& command, const LoadedScene& loaded) {
    ComparisonOptions options;
    const FrameRange range = frameRange(command.solve.frames);
    const RadiosityOptions resolved = resolvedOptions(command.solve, loaded, double(range.first));
    options.meshing = resolved.meshing;
    options.solving = resolved.solving;
    options.width = command.width;
    options.height = command.height;
    options.growth = command.growth;
    if (command.dirty == "perfect") options.dirty = DirtySetKind::perfect;
    const std::int64_t film =
        command.filmFrame == 0 ? 0 : std::int64_t(command.filmFrame) - range.first - 1;
    if (film < 0 || film >= range.last - range.first)
        throw CLI::ValidationError("--film",
                                   fmt::format("{} is no frame from {} to {}", command.filmFrame,
                                               range.first + 1, range.last));
    options.filmFrame = int(film);
    options.filmSeconds = {0};
    for (double ms = 1; ms < 70'000; ms *= 2) options.filmSeconds.push_back(1e-3 * ms);
    return options;
}

/// \param names separated by commas; empty: the usual ones
std::vector<PolicyUnderTest> chosenPolicies(const std::string& names) {
    std::vector<PolicyUnderTest> known = allPolicies();
    if (names.empty()) return usualPolicies();
    std::vector<PolicyUnderTest> chosen;
    std::istringstream list(names);
    for (std::string name; std::getline(list, name, ',');) {
        const auto found = std::find_if(known.begin(), known.end(),
                                        [&](const auto& policy) { return policy.name == name; });
        if (found == known.end()) {
            std::string all;
            for (const auto& policy : known) all += (all.empty() ? "" : ", ") + policy.name;
            throw CLI::ValidationError("--orders",
                                       fmt::format("no policy '{}' (there are {})", name, all));
        }
        chosen.push_back(*found);
    }
    return chosen;
}

std::string viewerMotion(const CompareCommand& command) {
    if (!command.cutFrom.empty())
        return "sees from " + command.cutFrom + " until 10 % of the work is done";
    if (command.pan != 0)
        return fmt::format("turns by {} degrees while the work is done; the error is that in the "
                           "view of the moment",
                           command.pan);
    return "stays";
}

std::string askedFor(std::optional<double> metres) {
    return metres ? fmt::format("edges of {} m asked for", *metres) : "no size asked for";
}

ReportOptions reportOptions(const CompareCommand& command, const ComparisonResult& result) {
    const SolverOptions& solver = command.solve.solver;
    ReportOptions report;
    const std::string name = std::filesystem::path(command.solve.scene).filename().string();
    report.title = fmt::format("{}: scheduling policies compared", name);
    report.settings = {
        {"scene", name},
        {"frames", command.solve.frames},
        {"camera", command.camera.empty() ? "the first one" : command.camera},
        {"the viewer", viewerMotion(command)},
        {"dirty set", command.dirty == "perfect"
                          ? "perfect: of direct light only entries that come out otherwise"
                          : "bounding shafts: what may change"},
        {"pictures", fmt::format("{} x {} pixels, {:.1f} pixels per degree", command.width,
                                 command.height, result.pixelsPerDegree)},
        {"elements",
         fmt::format("{}, {}", result.elements, askedFor(command.solve.asked.elementSize))},
        {"patches", fmt::format("{}, {}", result.patches, askedFor(command.solve.asked.patchSize))},
        {"lights", std::to_string(result.lights)},
        {"light", solver.directOnly ? "direct only" : "direct and indirect"},
        {"visibility samples", std::to_string(solver.samples)},
        {"residual", command.solve.asked.residual ? fmt::format("{}", *command.solve.asked.residual)
                                                  : "default"},
        {"visible error", "mean over pixels, in JND; contrast sensitivity of castleCSF, bands and "
                          "masking of ColorVideoVDP"},
        {"program", "penumbra " PENUMBRA_VERSION}};
    report.machine = machineFacts();
    return report;
}

void run(CompareCommand command) {
    const ThreadLimit limit(command.solve.threads);
    if (command.json.empty())
        command.json = std::filesystem::path(command.output).replace_extension(".json").string();
    checkOutputs({command.solve.scene}, {command.output, command.json});
    ProgressBar progress(whenToShowProgress(command.solve));
    LoadOptions load;
    load.allowOutside = command.solve.allowOutside;
    load.time = frameRange(command.solve.frames).first;
    LoadedScene loaded = loadUsdScene(command.solve.scene, load);
    checkOutputs(loaded.files, {command.output, command.json});
    if (!command.solve.quiet) reportDiagnostics(loaded.diagnostics, command.solve.verbose);
    if (!loaded.animation)
        throw SceneFileError({command.solve.scene},
                             "nothing moves: the file has no animation to play");
    const PlacedScene placed = placeScene(*loaded.scene);
    if (command.height == 0)
        command.height = heightFor(placed, command.camera, command.solve.scene, command.width);
    const Playback playback = playbackOf(command, loaded);
    const std::vector<PolicyUnderTest> policies = chosenPolicies(command.policies);
    const ComparisonResult result =
        comparePolicies(playback, policies, optionsOf(command, loaded),
                        [&](const char* phase, double done) { progress.show(phase, done); });
    progress.clear();
    const ReportOptions report = reportOptions(command, result);
    writeFileAtomically(command.json, comparisonJson(result, report));
    writeFileAtomically(command.output, htmlReport(result, report));
    if (command.solve.quiet) return;
    const std::string unseen = whatIsNotSeen(result);
    if (!unseen.empty()) fmt::print(stderr, "{}: {}\n", command.solve.scene, unseen);
    if (seenEdits(result).empty()) return;
    for (const PolicyFigures& f : figuresOf(result))
        fmt::print(stderr, "{:<12} area {:.4f}, {} rays' worth to 10 % of the error, {} in all\n",
                   f.name, f.area, f.work10 < 0 ? "never" : fmt::format("{:.0f}", f.work10),
                   fmt::format("{:.0f}", f.work));
}

/// The viewer: from where, and the size of the pictures.
void addViewOptions(CLI::App& compare, CompareCommand& command) {
    compare.add_option("--camera", command.camera, "Path of the camera (default: the first one)");
    compare.add_option("--cut-from", command.cutFrom,
                       "Camera that the viewer has first; after a tenth of the work they have\n"
                       "--camera, in which the error is measured all the time");
    compare
        .add_option("--pan", command.pan,
                    "The viewer turns to the left by so much while the work is done, half of it\n"
                    "before and half after the middle of --camera; the error is that in the view\n"
                    "of the moment [degrees]")
        ->check(CLI::Range(-180.0, 180.0))
        ->excludes("--cut-from");
    compare.add_option("--width", command.width, "Of the pictures that are compared [pixels]")
        ->capture_default_str()
        ->check(CLI::Range(16, 4096));
    compare
        .add_option("--height", command.height,
                    "Of the pictures [pixels] (default: as the camera's film is shaped)")
        ->check(CLI::Range(16, 4096));
}

void addPolicyOptions(CLI::App& compare, CompareCommand& command) {
    compare.add_option(
        "--orders", command.policies,
        "Policies to compare, with commas: plain, importance, random (random2 ... random5),\n"
        "bound, geometry, oracle, or importance without one of its factors: no-change, no-probe,\n"
        "no-contrast, no-size, no-frustum, no-occlusion, no-eccentricity, no-proximity\n"
        "(default: plain,importance,random,bound,oracle)");
    compare
        .add_option("--dirty", command.dirty,
                    "What is worked on: what bounding shafts find, of which much turns out not to\n"
                    "change, or as if it were known what does (perfect; direct light only)")
        ->capture_default_str()
        ->check(CLI::IsMember({"shafts", "perfect"}));
}

void addReportOptions(CLI::App& compare, CompareCommand& command) {
    compare.add_option("-o,--output", command.output, "HTML file to write")->required();
    compare.add_option("--json", command.json,
                       "All figures as JSON (default: beside the HTML file)");
    compare
        .add_option("--sample-growth", command.growth,
                    "The picture is sampled each time the work has grown by this factor")
        ->capture_default_str()
        ->check(CLI::Range(1.01, 10.0));
    compare.add_option("--film", command.filmFrame,
                       "Frame of the film strip (default: the second one)");
}

} // namespace

void addCompareCommand(CLI::App& app) {
    const auto command = std::make_shared<CompareCommand>();
    CLI::App* const compare = app.add_subcommand(
        "compare", "How soon the picture is right with each scheduling policy: an HTML report.\n"
                   "Example: penumbra compare scenes/office-seat.usda --frames 1:8 -o seat.html");
    addSolveOptions(*compare, command->solve);
    compare->remove_option(compare->get_option("--order")); // several are compared
    compare->get_option("--frames")->required();
    addReportOptions(*compare, *command);
    addViewOptions(*compare, *command);
    addPolicyOptions(*compare, *command);
    compare->callback([command] { run(*command); });
}

} // namespace penumbra
