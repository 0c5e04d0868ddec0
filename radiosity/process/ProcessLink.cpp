#include "radiosity/process/ProcessLink.h"

#include "base/Error.h"
#include "base/SystemError.h"
#include "radiosity/process/memory/ControlBlock.h"
#include "radiosity/process/memory/SharedRegions.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace penumbra {

namespace {

namespace fs = std::filesystem;

/// How a process that is to be started inherits things.
class SpawnSettings {
public:
    SpawnSettings() {
        posix_spawn_file_actions_init(&files_);
        posix_spawn_file_actions_addopen(&files_, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&files_, 1, "/dev/null", O_WRONLY, 0);
        posix_spawnattr_init(&attributes_);
        // A group of its own: Ctrl-C in the terminal is for the viewer.
        posix_spawnattr_setpgroup(&attributes_, 0);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&files_);
        posix_spawnattr_destroy(&attributes_);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    const posix_spawn_file_actions_t* files() const { return &files_; }
    const posix_spawnattr_t* attributes() const { return &attributes_; }

private:
    posix_spawn_file_actions_t files_;
    posix_spawnattr_t attributes_;
};

pid_t spawn(const std::string& program, std::vector<std::string> arguments) {
    std::vector<char*> list;
    for (std::string& argument : arguments) list.push_back(argument.data());
    list.push_back(nullptr);
    const SpawnSettings settings;
    pid_t process = 0;
    const int error = posix_spawn(&process, program.c_str(), settings.files(),
                                  settings.attributes(), list.data(), environ);
    if (error != 0) throw Error(program + ": can't be started: " + reasonOf(error, FileUse::read));
    return process;
}

class ProcessLink : public LightingLink {
public:
    explicit ProcessLink(ProcessLinkOptions options) : options_(std::move(options)) {}
    ~ProcessLink() override {
        ProcessLink::end();
        for (pid_t process : dying_) waitpid(process, nullptr, 0); // killed: it can't take long
    }
    Regions& regions() override { return *regions_; }
    bool apart() const override { return true; }
    bool byHand() const override { return bool(options_.byHand); }

    void start(const RegionPtr& control, const WorkerLimits& limits) override {
        end();
        control_ = control;
        if (byHand()) return options_.byHand(control->name());
        const std::string program =
            options_.program.empty() ? findPenumbra() : options_.program.string();
        process_ = spawn(program, {program, "radiosity", control->name(), "--threads",
                                   std::to_string(limits.threads), "--nice",
                                   std::to_string(limits.niceness)});
    }

    std::optional<std::string> ended() override {
        std::erase_if(dying_,
                      [](pid_t process) { return waitpid(process, nullptr, WNOHANG) != 0; });
        if (process_ == 0) return std::nullopt;
        int status = 0;
        const pid_t found = waitpid(process_, &status, WNOHANG);
        if (found == 0) return std::nullopt;
        process_ = 0;
        if (found > 0 && WIFSIGNALED(status))
            return std::string("the process was ended by signal ") +
                   std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")";
        if (found > 0 && WIFEXITED(status) && WEXITSTATUS(status) != 0)
            return "the process failed with exit code " + std::to_string(WEXITSTATUS(status));
        return "the process has ended";
    }

    void end() override {
        if (control_) // one that was started by hand
            reinterpret_cast<ControlBlock*>(control_->bytes().data())
                ->stop.store(1, std::memory_order_relaxed);
        control_.reset();
        if (process_ == 0) return;
        kill(process_, SIGKILL); // it owns nothing that it would have to clean up
        dying_.push_back(std::exchange(process_, 0));
    }

private:
    ProcessLinkOptions options_;
    std::unique_ptr<Regions> regions_ = makeSharedRegions();
    RegionPtr control_;
    pid_t process_ = 0;
    std::vector<pid_t> dying_; ///< killed, but still to be waited for
};

} // namespace

std::string findPenumbra() {
    std::error_code ignored;
    const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
    if (self.filename() == "penumbra") return self.string();
    std::vector<fs::path> places{self.parent_path()};
    if (const char* const path = std::getenv("PATH")) {
        std::istringstream list(path);
        for (std::string place; std::getline(list, place, ':');) places.emplace_back(place);
    }
    for (const fs::path& place : places)
        if (!place.empty() && access((place / "penumbra").c_str(), X_OK) == 0)
            return (place / "penumbra").string();
    throw Error("penumbra: not found beside " + self.string() +
                " or on the PATH (name it in ProcessLinkOptions)");
}

std::unique_ptr<LightingLink> makeProcessLink(ProcessLinkOptions options) {
    return std::make_unique<ProcessLink>(std::move(options));
}

} // namespace penumbra
