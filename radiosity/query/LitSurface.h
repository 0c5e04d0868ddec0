// The solution as it is drawn: read at points, and as a branch of the scene graph.
#pragma once

#include "radiosity/mesh/PatchSet.h"
#include "radiosity/query/DrawnSurface.h"
#include "radiosity/transport/Solver.h"
#include "scenegraph/Group.h"

#include <glm/glm.hpp>

#include <memory>
#include <optional>

namespace penumbra {

/// The lit patches of a scene as a branch of the scene graph, one LitGeometry an object.
class LitBranch : public Group {
public:
    /// \param light as long as patches.vertices
    LitBranch(const PatchSet& patches, const Lighting& light);
};

/// A point of the drawn surface.
struct SurfaceSample {
    std::uint32_t element = 0;
    glm::vec3 position{};
    glm::vec3 normal{};   ///< unit, interpolated
    Rgb direct, indirect; ///< interpolated as the renderer does it, on triangles [lux]
    Rgb reflectance;      ///< there, in a texture at full resolution
    Rgb emission;         ///< likewise [nit]
    float distance = 0;   ///< along the ray, in units of its direction
};

/// Finds points on the drawn surface by rays against the elements' triangles.
class LitSurface {
public:
    /// Both must outlive this.
    LitSurface(const PatchSet& patches, const Lighting& light);

    /// The first element that shows its front.
    std::optional<SurfaceSample> trace(glm::vec3 origin, glm::vec3 direction) const;
    /// The surface under a sensor: within a hair of `position`, facing along `normal`.
    std::optional<SurfaceSample> under(glm::vec3 position, glm::vec3 normal) const;

private:
    std::optional<SurfaceSample> sample(glm::vec3 origin, glm::vec3 direction, float reach) const;

    const PatchSet& patches_;
    const Lighting& light_;
    DrawnSurface surface_;
};

} // namespace penumbra
