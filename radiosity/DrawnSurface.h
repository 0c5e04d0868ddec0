// Rays against the elements as they are drawn.
#pragma once

#include "radiosity/PatchSet.h"
#include "radiosity/RayScene.h"

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

    bool met() const { return element != Element::kNone; }
};

/// The elements' triangles, cut as the renderer cuts them. Only fronts are met.
class DrawnSurface {
public:
    enum class Which { all, fixed };
    /// \param which all that is there now, or the part that never moves
    explicit DrawnSurface(const PatchSet& patches, Which which = Which::all);
    DrawnHit nearest(glm::vec3 origin, glm::vec3 direction, float reach) const;

private:
    const PatchSet& patches_;
    std::vector<std::uint32_t> triangles_; ///< element * 2 + (0: corners 0 1 2, 1: corners 0 2 3)
    RayScene rays_;
};

} // namespace penumbra
