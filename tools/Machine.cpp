#include "tools/Machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <ctime>
#include <fstream>
#include <string>
#include <thread>

namespace penumbra {

namespace {

/// The value of the first line that begins with `key` and has one after a ':' or '='.
std::string valueIn(const char* path, const std::string& key) {
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(key)) continue;
        const std::size_t at = line.find_first_of(":=");
        const std::size_t first = line.find_first_not_of(" \t\"", at + 1);
        if (at == std::string::npos || first == std::string::npos) continue;
        return line.substr(first, line.find_last_not_of(" \"") - first + 1);
    }
    return {};
}

} // namespace

Facts machineFacts() {
    Facts facts;
    const auto add = [&](const char* name, const std::string& value) {
        if (!value.empty()) facts.emplace_back(name, value);
    };
    add("processor", valueIn("/proc/cpuinfo", "model name"));
    add("hardware threads", std::to_string(std::thread::hardware_concurrency()));
    struct sysinfo info {};
    if (sysinfo(&info) == 0)
        add("memory", fmt::format("{:.1f} GB", double(info.totalram) * info.mem_unit * 1e-9));
    add("system", valueIn("/etc/os-release", "PRETTY_NAME"));
    utsname name{};
    if (uname(&name) == 0) add("kernel", name.release);
#ifdef __VERSION__
    add("compiler", __VERSION__);
#endif
    add("date", fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))));
    return facts;
}

} // namespace penumbra
