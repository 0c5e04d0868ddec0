#include "tools/CameraChoice.h"

#include "io/UsdScene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penumbra {

const Placed<Camera>* chooseCamera(const PlacedScene& placed, const std::string& path,
                                   const std::string& file) {
    if (path.empty()) return placed.cameras.empty() ? nullptr : &placed.cameras.front();
    const auto matches = [&](const Placed<Camera>& camera) {
        // A camera prim with a transform of its own is two nodes of the same name.
        return camera.path == path || camera.path == path + "/" + camera.node->name();
    };
    const auto found = std::find_if(placed.cameras.begin(), placed.cameras.end(), matches);
    if (found != placed.cameras.end()) return &*found;
    std::string known;
    for (const auto& camera : placed.cameras) known += (known.empty() ? "" : ", ") + camera.path;
    throw SceneFileError({file},
                         fmt::format("no camera '{}' ({})", path,
                                     known.empty() ? "the file has none" : "it has " + known));
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
