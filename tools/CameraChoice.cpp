#include "tools/CameraChoice.h"

#include "viewer/input/CameraRig.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace penumbra {

const Placed<Camera>* chooseCamera(const PlacedScene& placed, const std::string& path,
                                   const std::string& file) {
    if (path.empty()) return placed.cameras.empty() ? nullptr : &placed.cameras.front();
    return &placed.cameras[cameraIndex(placed, path, file)];
}

int heightFor(const PlacedScene& placed, const std::string& path, const std::string& file,
              int width) {
    const auto* const camera = chooseCamera(placed, path, file);
    const Lens lens =
        camera ? camera->node->lens() : Lens{.horizontalAperture = 16, .verticalAperture = 9};
    const float shape = lens.verticalAperture / lens.horizontalAperture;
    return std::clamp(int(std::lround(float(width) * shape)), 1, 16384);
}

View viewOf(const PlacedScene& placed, UpAxis up, const std::string& path, const std::string& file,
            int width, int height) {
    if (const auto* const camera = chooseCamera(placed, path, file))
        return makeView(camera->node->lens(), camera->toWorld, width, height);
    return frameBox(placed.bounds.lower, placed.bounds.upper, int(up), width, height);
}

std::vector<std::string> namesForFiles(const std::vector<std::string>& cameras) {
    std::vector<std::string> names;
    const auto last = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
    for (const std::string& path : cameras) {
        const auto alike = std::ranges::count(cameras, last(path), last);
        std::string name = alike > 1 ? path.substr(path.find_first_not_of('/')) : last(path);
        std::ranges::replace(name, '/', '-');
        names.push_back(std::move(name));
    }
    return names;
}

std::string withCamera(std::string pattern, const std::string& name) {
    constexpr std::string_view kPlace = "{camera}";
    for (std::size_t at = pattern.find(kPlace); at != std::string::npos;
         at = pattern.find(kPlace, at + name.size()))
        pattern.replace(at, kPlace.size(), name);
    return pattern;
}

} // namespace penumbra
