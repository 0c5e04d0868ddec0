#include "tools/CameraChoice.h"

#include "viewer/input/CameraRig.h"

#include <algorithm>
#include <cmath>

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

} // namespace penumbra
