#include "base/MemoryError.h"
#include "io/image/UnfinishedFile.h"
#include "tools/Commands.h"
#include "tools/RefusedCommandLine.h"

#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <system_error>

namespace {

/// \return the exit code; what a command could not do is thrown
int run(int argc, char** argv) {
    CLI::App app{"Penumbra: soft, physically right light for scenes in which things move.\n"
                 "Reads USD (text, binary, packages) and models (glTF, OBJ, FBX, Collada, PLY,\n"
                 "STL), solves radiosity, shows it in a window or writes lit frames.\n",
                 "penumbra"};
    app.set_version_flag("--version", "penumbra " PENUMBRA_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Each command explains itself: penumbra render --help\n"
        "Exit codes: 0 done; 1 it failed, and one line says why; 2 the command line was wrong.");
    penumbra::addViewCommand(app);
    penumbra::addRenderCommand(app);
    penumbra::addSolveCommand(app);
    penumbra::addInfoCommand(app);
    penumbra::addImportCommand(app);
    penumbra::addRadiosityCommand(app);
    penumbra::addCompareCommand(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) { // --help, --version
        return app.exit(success);
    } catch (const CLI::ParseError& error) {
        const auto words = std::span<const char* const>(argv, std::size_t(argc)).subspan(1);
        std::fprintf(stderr, "%s\n", penumbra::aboutRefusal(app, words, error).c_str());
        return 2;
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    // A full disk or a closed pipe is reported by the failing write, not by a signal.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGCHLD, SIG_DFL); // who starts us may ignore it: then no child could be waited for
    penumbra::removeUnfinishedFilesOnSignals();
    penumbra::spareAddressSpaceIfLimited();
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s\n", penumbra::MemoryError("for the scene").what());
    } catch (const std::system_error&) { // of std::thread: files throw Error
        std::fprintf(stderr, "%s\n", penumbra::MemoryError("for another thread").what());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
    return 1;
}
