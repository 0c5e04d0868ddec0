// Reading a scene while the window is already there.
#pragma once

#include "base/LightRequest.h"
#include "io/usd/scene/UsdScene.h"
#include "radiosity/query/SceneRays.h"
#include "scenegraph/Objects.h"

#include <future>
#include <memory>
#include <optional>
#include <string>

namespace penumbra {

/// A scene with what the walkthrough needs of it at once.
struct ReadyScene {
    LoadedScene loaded;
    PlacedScene placed;
    LightRequest settings; ///< of the light, where nobody but the file asks: lightSettings()
    std::unique_ptr<SceneRays> rays;
};

/// Reads a file in a thread of its own. Waits for it at destruction.
class SceneLoader {
public:
    explicit SceneLoader(std::string file, const LoadOptions& options = {});

    /// The scene, once, when it is there. \throws Error what reading it threw
    std::optional<ReadyScene> take();
    bool busy() const { return future_.valid(); }
    const std::string& file() const { return file_; }

private:
    std::string file_;
    std::future<ReadyScene> future_;
};

} // namespace penumbra
