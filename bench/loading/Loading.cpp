// Writes large files, and reads one as a process of its own: peak memory is that of reading.
//
// - penumbra_loading write FOLDER: mesh.usda, mesh.usdc (a million points), prims.usda, prims.usdc
//   (20,000 spheres)
// - penumbra_loading layer FILE, penumbra_loading scene FILE: reads the layer alone, or makes the
//   scene graph of it; prints seconds and peak bytes as JSON
#include "bench/PeakMemory.h"
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
