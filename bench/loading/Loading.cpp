// Writes large files, and reads one as a process of its own, so that peak memory is that of
// reading.
//
//   penumbra_loading write FOLDER   mesh.usda, mesh.usdc (1 M points), prims.usda, prims.usdc
//   (20,000 spheres) penumbra_loading layer FILE     the layer alone:   prints seconds and peak
//   bytes penumbra_loading scene FILE     the scene graph:   the same
#include "bench/loading/LoadingFiles.h"
#include "io/usd/crate/UsdFiles.h"
#include "io/usd/scene/UsdScene.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace penumbra {

namespace {

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream out(file, std::ios::binary);
    out << bytes;
    if (!out.flush()) throw std::runtime_error(file.string() + ": can't be written");
}

void writeFiles(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    write(folder / "mesh.usda", meshText(1'000'000));
    write(folder / "mesh.usdc", meshCrate(1'000'000));
    write(folder / "prims.usda", primsText(20'000));
    write(folder / "prims.usdc", primsCrate(20'000));
}

/// [bytes] Not getrusage(): its figure survives exec() and so may be that of the starting program.
std::size_t peakMemory() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        std::size_t kilobytes = 0;
        if (word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024;
    }
    return 0;
}

/// Prints what reading takes. `read` returns what it has read, which lives until all is measured.
template <class Read>
void measure(Read read) {
    const auto begin = std::chrono::steady_clock::now();
    const auto what = read();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    fmt::print("{{\"seconds\": {}, \"peak_bytes\": {}}}\n", took.count(), peakMemory());
}

int run(std::string_view command, const std::filesystem::path& path) {
    if (command == "write") writeFiles(path);
    if (command == "layer") measure([&] { return readAnyUsdLayer(path); });
    if (command == "scene") measure([&] { return loadUsdScene(path); });
    return 0;
}

} // namespace

} // namespace penumbra

int main(int count, char** arguments) {
    if (count != 3) return 2;
    return penumbra::run(arguments[1], arguments[2]);
}
