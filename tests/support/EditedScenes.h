// Random rooms, random edits, and the comparison with a scene that is lit from scratch.
#pragma once

#include "radiosity/LitScene.h"
#include "tests/support/Scenes.h"

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace penumbra {

/// A room with things that move, made from a seed: boxes and plates that touch and overlap, an
/// instanced pair, one below a scaled parent, lamps with housings, switches.
class EditableRoom {
public:
    explicit EditableRoom(std::uint32_t seed);

    /// One random edit, or several at once. \return what was done, for people
    std::string edit();

    const Scene& scene() const { return scene_; }
    static constexpr MeshingOptions meshing() { return {.patchSize = 0.7f, .elementSize = 0.24f}; }

private:
    std::shared_ptr<Transform> addMovable(const std::string& name, NodePtr content);
    glm::dmat4 anywhere();
    double uniform(double low, double high);
    std::size_t below(std::size_t count);

    std::mt19937 random_;
    Scene scene_;
    std::vector<std::shared_ptr<Transform>> things_;
    std::vector<glm::dmat4> home_; ///< a pose to come back to
    std::vector<std::shared_ptr<Switch>> switches_;
    std::vector<std::shared_ptr<Light>> lights_;
    std::vector<std::shared_ptr<Material>> paints_;
};

/// What differs between two lit scenes of the same things, object by object: empty if visibility is
/// the same bit for bit and radiosity agrees within both certificates.
std::string difference(const LitScene& a, const LitScene& b);

} // namespace penumbra
