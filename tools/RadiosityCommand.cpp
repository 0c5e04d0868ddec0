#include "radiosity/process/LightingProcess.h"
#include "tools/Commands.h"
#include "tools/SceneSolution.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace penumbra {

namespace {

struct RadiosityCommand {
    std::string name;
    WorkerLimits limits;
};

} // namespace

void addRadiosityCommand(CLI::App& app) {
    auto command = std::make_shared<RadiosityCommand>();
    CLI::App* const radiosity = app.add_subcommand(
        "radiosity", "The radiosity process: lights what a viewer shows.\n"
                     "Viewers start it; to debug it, start it by hand with the name that a viewer\n"
                     "gives when it is not to start one.");
    radiosity->add_option("NAME", command->name, "Of the memory that the viewer shares")
        ->required();
    radiosity
        ->add_option("--threads", command->limits.threads, "Threads to use (default: one a core)")
        ->check(CLI::Range(0u, 1024u));
    addMemoryOption(*radiosity, command->limits.memory);
    radiosity
        ->add_option("--nice", command->limits.niceness, "How much others come first, see nice(1)")
        ->check(CLI::Range(0, 19));
    radiosity->callback([command] { runLightingProcess(command->name, command->limits); });
}

} // namespace penumbra
