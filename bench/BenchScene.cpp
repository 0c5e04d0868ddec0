#include "bench/BenchScene.h"

#include <chrono>
#include <ctime>
#include <filesystem>

namespace penumbra {

namespace {

double wallClock() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

double cpuClock() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

double threadClock() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

} // namespace

LoadedScene loadScene(const std::string& name) {
    const std::filesystem::path path(name);
    if (path.has_extension()) return loadUsdScene(path);
    return loadUsdScene(std::filesystem::path(PENUMBRA_SOURCE_DIR) / "scenes" / (name + ".usda"));
}

MeshingOptions meshingOf(const LightRequest& asked, float elementSize) {
    MeshingOptions options;
    options.patchSize = float(asked.patchSize.value_or(0));
    options.elementSize = elementSize;
    return options;
}

BenchScene::BenchScene(const std::string& name)
    : loaded_(loadScene(name)), placed_(placeScene(*loaded_.scene)) {}

BuiltPatches BenchScene::mesh(float elementSize, float patchSize) const {
    MeshingOptions meshing = meshingOf(loaded_.asked, elementSize);
    if (patchSize > 0) meshing.patchSize = patchSize;
    return buildPatches(placed_, meshing);
}

Stopwatch::Stopwatch()
    : wallStart_(wallClock()), cpuStart_(cpuClock()), threadStart_(threadClock()) {}
double Stopwatch::thread() const {
    return threadClock() - threadStart_;
}
double Stopwatch::wall() const {
    return wallClock() - wallStart_;
}
double Stopwatch::cpu() const {
    return cpuClock() - cpuStart_;
}

} // namespace penumbra
