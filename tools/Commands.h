// The subcommands of the program. Each adds itself to the command line and runs when it was chosen.
#pragma once

namespace CLI {
class App;
}

namespace penumbra {

void addViewCommand(CLI::App& app);
void addRenderCommand(CLI::App& app);
void addSolveCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addImportCommand(CLI::App& app);
void addRadiosityCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);

} // namespace penumbra
