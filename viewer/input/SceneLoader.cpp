#include "viewer/input/SceneLoader.h"

#include "base/Error.h"
#include "viewer/input/LightSettings.h"

#include <chrono>

namespace penumbra {

namespace {

ReadyScene readyScene(const std::string& file, const LoadOptions& options) {
    ReadyScene ready;
    ready.loaded = loadUsdScene(file, options);
    ready.placed = placeScene(*ready.loaded.scene);
    if (ready.placed.meshes.empty() && ready.placed.lights.empty())
        throw SceneFileError({file}, "nothing to see: no visible mesh that can be read");
    auto rays =
        std::async(std::launch::async, [&] { return std::make_unique<SceneRays>(ready.placed); });
    ready.settings = lightSettings(file, ready.loaded, options.time, {});
    ready.rays = rays.get();
    return ready;
}

} // namespace

SceneLoader::SceneLoader(std::string file, const LoadOptions& options)
    : file_(std::move(file)), future_(std::async(std::launch::async, readyScene, file_, options)) {}

std::optional<ReadyScene> SceneLoader::take() {
    if (!busy() || future_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return std::nullopt;
    return future_.get();
}

} // namespace penumbra
