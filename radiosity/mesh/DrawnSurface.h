// Rays against the elements as they are drawn.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra {

/// Where a ray meets the drawn surface.
struct DrawnHit {
    std::uint32_t element = Element::kNone;
    std::array<std::uint32_t, 3> vertices{}; ///< of the triangle that is drawn there
    std::array<float, 3> weights{};          ///< barycentric
    float distance = 0;                      ///< in units of the ray's direction
    bool second = false; ///< of a quadrilateral's halves; its corners are then 0 2 3, else 0 1 2

    bool met() const { return element != Element::kNone; }
};

/// Texture coordinates of a hit; zero if there are no textures.
glm::vec2 uvOf(const PatchSet& patches, const DrawnHit& hit);

/// The elements' triangles, cut as the renderer cuts them. Only fronts are met. Each object is a
/// geometry of its own, so that one that moves is refitted and the others stay.
class DrawnSurface {
public:
    explicit DrawnSurface(const PatchSet& patches);

    /// Takes in objects that came to the patch set.
    void grow();
    /// Takes in that objects were posed anew, hidden or shown in the patch set.
    void follow(std::span<const ObjectId> objects);

    /// What is met first. Of surfaces that lie on each other it is the same one however the scene
    /// came to be as it is.
    DrawnHit nearest(glm::vec3 origin, glm::vec3 direction, float reach) const;

private:
    struct Part {
        std::uint32_t object = 0;
        std::vector<std::uint32_t> triangles; ///< element * 2 + (0: corners 0 1 2, 1: 0 2 3)
    };
    std::vector<RayMesh> meshes();
    void hideAbsent();

    const PatchSet& patches_;
    std::vector<Part> parts_; ///< objects in an order that does not depend on what else there is
    std::vector<std::uint32_t> partOf_; ///< by object
    RayScene rays_;                     ///< of the parts
};

} // namespace penumbra
