// What happens to a scene while somebody is in it, as a layer over the scene's file.
#pragma once

#include "io/usd/scene/UsdScene.h"
#include "scenegraph/Camera.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace penumbra {

/// Follows a loaded scene by the revisions of its nodes and writes what changes as USD time
/// samples: transforms, lights, materials, the camera. Loading the layer is replaying the session:
/// UsdAnimation plays it, and so does every other program that reads USD.
///
/// The layer has the scene's file as its sublayer. Transforms are written as translate, orient and
/// scale (a matrix if they are sheared or mirrored), the camera over the first camera of the
/// file, or, if it has none, as /SessionCamera. What holds still has one value and no samples.
/// What is removed or hidden is invisible from then on, and inactive or invisible in a layer of
/// edits; a copy of a thing is a reference to its prim.
/// Colours that are factors of a texture are written as its scale; if others read that texture as
/// well, or it has a bias, its mean colour takes its place.
/// Time codes begin at 1 and count kRate a second.
class UsdRecording {
public:
    static constexpr double kRate = 30; ///< time codes a second

    /// Begins with the scene as it is. \param file the scene's; `scene`'s nodes are kept alive
    UsdRecording(const LoadedScene& scene, std::filesystem::path file);
    ~UsdRecording();
    UsdRecording(const UsdRecording&) = delete;
    UsdRecording& operator=(const UsdRecording&) = delete;

    /// Takes in what was added to the addresses since the recording began.
    void follow(const UsdAddresses& addresses);

    /// Takes in how things are at a time [s] since the beginning; between two time codes the last
    /// one counts. \param cameraToWorld [m] \param lens clipping range in metres
    void sample(double seconds, const glm::dmat4& cameraToWorld, const Lens& lens);

    /// Takes in how things are, as if they had been so from the beginning. The layer then has what
    /// was edited, and nothing of time and of the camera: the file's own animation plays on.
    /// \param hidden of what is not there: nodes that are to be invisible, not removed
    void takeEdits(std::span<const Node* const> hidden = {});

    /// The layer so far, as it is to be written to the file `path`.
    std::string text(const std::filesystem::path& path) const;
    /// Writes it, whole or not at all. \throws Error
    void write(const std::filesystem::path& layer) const;

    /// Names of what was edited but can't be written in a layer: colours of a mesh that has several
    /// of its own without materials, mesh lights, things that have no prim.
    std::vector<std::string> missed() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace penumbra
