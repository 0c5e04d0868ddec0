#include "base/Error.h"
#include "base/SystemError.h"
#include "tools/Commands.h"
#include "tools/DisplayOptions.h"
#include "tools/OutputFiles.h"
#include "tools/SceneSolution.h"
#include "viewer/app/Viewer.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace penumbra {

namespace {

struct ViewCommand {
    SolveSettings solve; ///< what of it counts: see addViewCommand()
    DisplaySettings display;
    ViewerOptions viewer;
};

void run(ViewCommand& command) {
    const std::string& scene = command.solve.scene;
    if (const std::string why = scene.empty() ? "" : whyUnreadable(scene); !why.empty())
        throw Error(scene + ": error: can't read: " + why); // before a window opens, or can't
    checkOutputs({scene}, {command.viewer.record});
    ViewerOptions& options = command.viewer;
    options.scene = scene;
    options.frame = command.solve.frame;
    options.allowOutside = command.solve.allowOutside;
    options.light.solving = command.solve.solver;
    options.asked = command.solve.asked;
    options.light.threads = command.solve.threads;
    std::error_code unknown; // what it is called does not matter then
    options.worker = std::filesystem::read_symlink("/proc/self/exe", unknown);
    options.exposure = command.display.exposure;
    options.tone = command.display.tone;
    options.reported = [&](const std::vector<Diagnostic>& diagnostics) {
        if (!command.solve.quiet) reportDiagnostics(diagnostics, command.solve.verbose);
    };
    options.opened = [&](const std::vector<std::filesystem::path>& layers) {
        checkOutputs(layers, {options.record});
    };
    runViewer(options);
}

} // namespace

void addViewCommand(CLI::App& app) {
    auto command = std::make_shared<ViewCommand>();
    CLI::App* const view = app.add_subcommand(
        "view", "The walkthrough: a window onto a scene, in which things are moved and the light\n"
                "follows. Press ? in it for its keys.\n"
                "Example: penumbra view scenes/office.usda --record take.usda");
    addSolveOptions(*view, command->solve);
    for (const char* name : {"--frames", "--from-scratch", "--stats", "--progress"})
        view->remove_option(view->get_option(name));
    view->add_option("--camera", command->viewer.camera,
                     "Path of the camera to begin with (default: the first one)");
    addDisplayOptions(*view, command->display, "as it was when the window was closed");
    view->add_option("--record", command->viewer.record,
                     "Write the session (camera, edits, times) to this file, as a USD layer over\n"
                     "the scene: view --replay and render --frames play it");
    view->add_flag("--replay", command->viewer.replay,
                   "Play the file's animation, such as a recorded session, from its start");
    view->add_flag("!--no-vsync", command->viewer.vsync, "Draw as many pictures as possible");
    view->callback([command] { run(*command); });
}

} // namespace penumbra
