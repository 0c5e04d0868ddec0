#include "tools/Commands.h"
#include "viewer/Viewer.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace penumbra {

void addViewCommand(CLI::App& app) {
    auto options = std::make_shared<ViewerOptions>();
    CLI::App* const view = app.add_subcommand(
        "view", "The walkthrough: a window onto a scene. Press ? in it for its keys.\n"
                "Example: penumbra view scenes/office.usda");
    view->add_option("SCENE", options->scene, "USD text file (.usda) to walk through")->required();
    view->add_flag("!--no-vsync", options->vsync, "Draw as many pictures as possible");
    view->callback([options] { runViewer(*options); });
}

} // namespace penumbra
