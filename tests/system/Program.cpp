#include "Program.h"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace penumbra {

namespace {

void limit(int resource, rlim_t value) {
    const rlimit both{value, value};
    setrlimit(resource, &both);
}

/// In the child: redirects, limits, becomes the program.
[[noreturn]] void becomeProgram(std::vector<char*>& arguments, const std::string& out,
                                const std::string& err, const RunLimits& limits) {
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    limit(RLIMIT_CPU, limits.cpuSeconds);
    limit(RLIMIT_CORE, 0);
    if (limits.addressBytes) limit(RLIMIT_AS, *limits.addressBytes);
    if (limits.childrenIgnored) std::signal(SIGCHLD, SIG_IGN);
    alarm(limits.seconds); // the program that it becomes keeps it
    if (limits.fileBytes) limit(RLIMIT_FSIZE, *limits.fileBytes);
    execv(PENUMBRA_PROGRAM, arguments.data());
    _exit(127);
}

/// Waits until a file appears in the folder that is watched, or the child has ended.
void endAtFirstFile(pid_t child, int watch) {
    pollfd created{watch, POLLIN, 0};
    siginfo_t ended{};
    while (poll(&created, 1, 20) == 0 && ended.si_pid == 0)
        waitid(P_PID, id_t(child), &ended, WEXITED | WNOHANG | WNOWAIT);
    kill(child, SIGTERM);
}

} // namespace

Outcome runPenumbra(const std::vector<std::string>& arguments, const RunLimits& limits) {
    const Workplace streams;
    const std::string out = streams.path("out"), err = streams.path("err");
    std::vector<std::string> words{"penumbra"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int watch = inotify_init1(IN_CLOEXEC);
    if (!limits.endWhenItWritesInto.empty())
        inotify_add_watch(watch, limits.endWhenItWritesInto.c_str(), IN_CREATE);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0) becomeProgram(pointers, out, err, limits);
    if (!limits.endWhenItWritesInto.empty()) endAtFirstFile(child, watch);
    close(watch);
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(out), readFile(err)};
}

std::string Workplace::write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text).string();
}

std::vector<std::string> Workplace::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string readFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::size_t lineCount(const std::string& text) {
    return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

std::string smallRoom() {
    return R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Room"
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 2, 6, 4, 1, 5, 7, 3, 0, 4, 5, 1, 2, 3, 7, 6, 0, 1, 3, 2, 4, 6, 7, 5]
    point3f[] points = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (2, 2, 0), (0, 0, 2), (2, 0, 2), (0, 2, 2), (2, 2, 2)]
    uniform token subdivisionScheme = "none"
    color3f[] primvars:displayColor = [(0.7, 0.6, 0.5)]
}
def Cube "Box"
{
    double size = 0.6
    double3 xformOp:translate = (1.1, 1.2, 0.3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def RectLight "Lamp"
{
    float inputs:intensity = 100
    float inputs:width = 0.8
    float inputs:height = 0.5
    double3 xformOp:translate = (1, 1, 1.99)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Eye"
{
    float focalLength = 15
    float2 clippingRange = (0.01, 100)
    double3 xformOp:translate = (1, 0.05, 1)
    double xformOp:rotateX = 85
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
)";
}

std::string meshUnderLight(const std::string& attributes) {
    return R"(#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "M"
{
    uniform token subdivisionScheme = "none"
)" + attributes +
           R"(
}
def RectLight "Lamp"
{
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
)";
}

std::vector<std::string> coarse() {
    return {"--patch-size", "0.5", "--element-size", "0.25"};
}

} // namespace penumbra
