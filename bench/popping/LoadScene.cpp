#include "LoadScene.h"

#include <chrono>
#include <thread>
#include <utility>

namespace penumbra {

ReadyScene loadScene(const std::string& scene) {
    SceneLoader loader(std::string(PENUMBRA_SOURCE_DIR) + "/scenes/" + scene + ".usda");
    for (;;) {
        if (auto ready = loader.take()) return std::move(*ready);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

} // namespace penumbra
