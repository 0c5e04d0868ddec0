// Rays against the elements as they are drawn.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/rays/RayScene.h"

#include <array>
#include <cstdint>
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

/// The elements' triangles, cut as the renderer cuts them, of what is there. Only fronts are met.
class DrawnSurface {
public:
    /// \param patches must outlive this, and stay as they are
    explicit DrawnSurface(const PatchSet& patches);

    /// What is met first. Of surfaces that lie on each other it is the same one however the scene
    /// came to be as it is.
    DrawnHit nearest(glm::vec3 origin, glm::vec3 direction, float reach) const;

private:
    std::vector<RayMesh> meshes();

    const PatchSet& patches_;
    /// By object: what each triangle is, element * 2 + (0: corners 0 1 2, 1: corners 0 2 3).
    std::vector<std::vector<std::uint32_t>> triangles_;
    RayScene rays_;
};

} // namespace penumbra
